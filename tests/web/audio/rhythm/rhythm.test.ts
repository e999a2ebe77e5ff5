import { describe, expect, it } from 'vitest';
import { musicFeatures } from '../../../../web/audio/features';
import { NO_RHYTHM, type Rhythm, rhythmOf } from '../../../../web/audio/rhythm/rhythm';
import { recipe } from '../../support/audio/audio-fixtures';
import * as make from '../../support/audio/made-song';
import { processorSeconds } from '../../support/processor-time';
import { absence, decodeRealSongs, realSongs } from '../../support/audio/real-songs';

const heard = (song: Float32Array): Rhythm => rhythmOf(musicFeatures(song, recipe).features, recipe);

/** Farthest distance of a beat from the nearest of the true ones, seconds. */
function farthest(beats: readonly number[], bpm: number, begin: number): number {
  const period = 60 / bpm;
  return Math.max(
    ...beats.map((beat) => {
      const off = (beat - begin) / period;
      return Math.abs(off - Math.round(off)) * period;
    }),
  );
}

/** What beats, tempo and metre say of a song agrees. */
function isConsistent({ beats, tempo, slowest, fastest }: Rhythm): boolean {
  const mean = (60 * (beats.length - 1)) / (beats.at(-1)! - beats[0]!);
  return (
    Math.abs(mean - tempo) < 1e-9 && slowest <= fastest && slowest < tempo * 1.01 && fastest > tempo * 0.99
  );
}

describe('clicks', () => {
  it.each([97.3, 144, 171.5].flatMap((bpm) => [3, 4].map((bar) => [bpm, bar] as const)))(
    'of %f BPM in bars of %i',
    (bpm, beatsPerBar) => {
      const rhythm = heard(make.clicks(bpm, beatsPerBar));
      expect(rhythm.tempo).toBeCloseTo(bpm, 0);
      expect(rhythm.sure).toBe(true);
      expect(rhythm.beatsPerBar).toBe(beatsPerBar);
      expect(farthest(rhythm.beats, bpm, 0.3)).toBeLessThan(0.006);
      const one = rhythm.beats[rhythm.first]!;
      expect(farthest([one], bpm / beatsPerBar, 0.3), 'the "1" begins a bar').toBeLessThan(0.02);
      expect(isConsistent(rhythm)).toBe(true);
    },
  );
});

describe('made music', () => {
  it.each([
    [97.3, 2 / 3],
    [144, 2 / 3],
    [120, 1 / 2],
  ])('of %f BPM, swing %f, is counted from its first bar of four', (bpm, swing) => {
    const rhythm = heard(make.swung(bpm, swing));
    expect(rhythm.tempo).toBeCloseTo(bpm, 0);
    expect(rhythm.beatsPerBar).toBe(4);
    expect(farthest([rhythm.beats[rhythm.first]!], bpm / 4, 0.5)).toBeLessThan(0.02);
  });

  it.each([90, 132.7, 178])('a waltz of %f BPM is counted in six', (bpm) => {
    const rhythm = heard(make.waltz(bpm));
    expect(rhythm.tempo).toBeCloseTo(bpm, 0);
    expect(rhythm.beatsPerBar).toBe(3);
    expect(farthest([rhythm.beats[rhythm.first]!], bpm / 3, 0.2)).toBeLessThan(0.03);
  });

  it('has beats while it plays, none in the silence before and after', () => {
    const { beats, tempo } = heard(make.joined(make.quiet(6), make.clicks(120, 4), make.quiet(6)));
    expect(tempo).toBeCloseTo(120, 0);
    expect(beats[0]).toBeCloseTo(6.3, 1);
    expect(beats.at(-1)).toBeGreaterThan(29);
    expect(beats.at(-1)).toBeLessThan(30);
  });

  it('has its beats on the bass drum, not on the hi-hat that is sharper between them', () => {
    const song = make.quiet(24);
    for (let beat = 0; beat < 45; beat++) {
      make.kick(song, 0.3 + beat / 2, 0.9);
      make.stroke(song, 0.55 + beat / 2, 0.8, 25);
    }
    const { beats, tempo } = heard(song);
    expect(tempo).toBeCloseTo(120, 0);
    expect(farthest(beats, 120, 0.3)).toBeLessThan(0.05);
  });

  it('keeps its beats where the tempo changes', () => {
    const change = 20;
    const rhythm = heard(make.joined(make.swung(100, 2 / 3, change), make.swung(135, 2 / 3, change)));
    expect(rhythm.slowest).toBeCloseTo(100, 0);
    expect(rhythm.fastest).toBeCloseTo(135, 0);
    const part = (from: number, to: number) => rhythm.beats.filter((beat) => beat > from && beat < to);
    expect(farthest(part(0, change - 3), 100, 0.5)).toBeLessThan(0.03);
    expect(farthest(part(change + 3, 2 * change), 135, change + 0.5)).toBeLessThan(0.03);
    expect(isConsistent(rhythm)).toBe(true);
  });
});

describe('no steady beat', () => {
  const cases: [string, Float32Array][] = [
    ['silence', new Float32Array(10 * recipe.sample_rate)],
    ['a hundred samples', new Float32Array(100).fill(0.1)],
  ];
  for (const seed of [1, 2, 3])
    cases.push(
      [`noise ${seed}`, make.whiteNoise(24, seed)],
      [`rain ${seed}`, make.rain(24, seed)],
      [`a whale ${seed}`, make.whale(30, seed)],
    );
  it.each(cases)('in %s', (_, song) => {
    expect(heard(song)).toEqual({ ...NO_RHYTHM, beats: [], tempo: 0 });
  });
});

/** The tempi that the machine-composed songs were ordered at. */
const ORDERED = {
  calm_acoustic_1: 68,
  energetic_acoustic_1: 132,
  energetic_electronic_2: 150,
  happy_acoustic_1: 110,
  happy_electronic_1: 123,
} as const;

it.skipIf(absence !== null)(
  `real songs have the tempo that they were made at${absence ? ` (${absence})` : ''}`,
  { timeout: 300_000 },
  () => {
    const songs = decodeRealSongs(realSongs);
    realSongs.forEach((name, index) => {
      const rhythm = heard(songs[index]!);
      const range = `${rhythm.slowest.toFixed(1)} to ${rhythm.fastest.toFixed(1)}`;
      console.log(`${name}: ${rhythm.tempo.toFixed(1)} BPM (${range}), bars of ${rhythm.beatsPerBar}`);
      expect(isConsistent(rhythm), name).toBe(true);
      const ordered = Object.entries(ORDERED).find(([song]) => name.startsWith(song))?.[1];
      if (ordered) expect(Math.abs(rhythm.tempo / ordered - 1), name).toBeLessThan(0.015);
      if (ordered) expect(rhythm.fastest / rhythm.slowest, name).toBeLessThan(1.03);
      // Strings that slow down and hurry are no steady beat.
      expect(rhythm.sure, name).toBe(!name.startsWith('Hungarian'));
      if (rhythm.sure) expect(rhythm.beatsPerBar, name).toBe(4);
    });
  },
);

it('takes far less time than the features', () => {
  const song = make.swung(120, 0.5, 60);
  // The shortest of five by turns: one run alone also counts what the compiler and the collector did meanwhile.
  const features: number[] = [];
  const rhythm: number[] = [];
  for (let turn = 0; turn < 5; turn++) {
    let columns!: Float32Array;
    features.push(processorSeconds(() => (columns = musicFeatures(song, recipe).features)));
    rhythm.push(processorSeconds(() => rhythmOf(columns, recipe)));
  }
  expect(Math.min(...rhythm)).toBeLessThan(0.2 * Math.min(...features));
});
