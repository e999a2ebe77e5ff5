/**
 * Songs in the manner of known styles, played with the small errors of people. No constant of the rhythm was chosen by
 * them: they test it on music that it was not made with.
 */
import { kick, quiet, randomNumbers, stroke, tone } from './made-song';

/** Largest error of a player, seconds, and the largest change of loudness, a share. */
const TIMING = 0.008;
const LOUDNESS = 0.25;

/** Second of the first beat. */
export const BEGIN = 0.4;
const SECONDS = 24;

/** Frequency of a MIDI note, hertz. */
const hertz = (note: number): number => 440 * 2 ** ((note - 69) / 12);

/** A song and the means to play it: times are beats from its beginning. */
class Band {
  readonly song = quiet(SECONDS);
  readonly #beat: number;
  readonly #random: () => number;

  constructor(bpm: number, seed: number) {
    this.#beat = 60 / bpm;
    this.#random = randomNumbers(seed);
  }

  /** Number of bars that fit. */
  bars(beatsPerBar: number): number {
    return Math.floor((SECONDS - BEGIN - 0.3) / (beatsPerBar * this.#beat));
  }

  note(at: number, note: number, beats: number, level: number): void {
    tone(this.song, this.#when(at), hertz(note), Math.max(0.06, beats * this.#beat), this.#loud(level));
  }

  chord(at: number, notes: readonly number[], beats: number, level: number): void {
    for (const note of notes) this.note(at, note, beats, level);
  }

  drum(at: number, level: number): void {
    kick(this.song, this.#when(at), this.#loud(level));
  }

  /** Snare (about 20), closed hi-hat or shaker (about 80), by how fast it decays. */
  noise(at: number, level: number, decay: number): void {
    stroke(this.song, this.#when(at), this.#loud(level), decay);
  }

  #when(at: number): number {
    return BEGIN + at * this.#beat + TIMING * (2 * this.#random() - 1);
  }

  #loud(level: number): number {
    return level * (1 + LOUDNESS * (2 * this.#random() - 1));
  }
}

/** C, A7, D7, G7: roots and chords above them, a bar each, as ragtime and swing go round. */
const CIRCLE = [
  [36, [60, 64, 67]],
  [33, [61, 64, 67]],
  [38, [60, 66, 69]],
  [31, [59, 65, 67]],
] as const;
/** A minor, G, F, E. */
const ANDALUSIAN = [
  [33, [60, 64, 69]],
  [31, [59, 62, 67]],
  [29, [60, 65, 69]],
  [28, [59, 64, 68]],
] as const;

type Chords = readonly (readonly [number, readonly number[]])[];
const at = (chords: Chords, bar: number) => chords[bar % chords.length]!;

/** A piano alone: bass and chord in turn on the beats, a syncopated melody of halves of a beat above them. */
function ragtime(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  const rhythm = [0, 0.5, 1.5, 2, 2.5, 3.5];
  const scale = [72, 76, 79, 81, 84, 79];
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(CIRCLE, bar);
    for (const beat of [0, 2]) {
      band.note(4 * bar + beat, root + (beat === 2 ? 7 : 0), 0.9, 0.7);
      band.chord(4 * bar + beat + 1, chord, 0.6, 0.25);
    }
    rhythm.forEach((beat, index) => band.note(4 * bar + beat, scale[(index + bar) % 6]!, 0.5, 0.35));
  }
  return band.song;
}

/** Bass on one, brushes, a swung ride, chords on the second and on the offbeat of the third. */
function jazzWaltz(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(3); bar++) {
    const [root, chord] = at(CIRCLE, Math.floor(bar / 2));
    band.note(3 * bar, root, 2, 0.7);
    band.note(3 * bar + 2, root + 7, 0.9, 0.4);
    band.chord(3 * bar + 1, chord, 0.5, 0.2);
    band.chord(3 * bar + 2 + 2 / 3, chord, 0.3, 0.15);
    for (const beat of [0, 1, 1 + 2 / 3, 2]) band.noise(3 * bar + beat, 0.2, 50);
    band.noise(3 * bar + 1, 0.25, 20);
  }
  return band.song;
}

/** A slow waltz of strings without drums: bass and two chords that begin softly. */
function slowWaltz(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(3); bar++) {
    const [root, chord] = at(ANDALUSIAN, bar);
    band.note(3 * bar, root + 12, 2.8, 0.6);
    for (const beat of [1, 2]) band.chord(3 * bar + beat, chord, 0.9, 0.18);
    band.note(3 * bar, 76 + (bar % 3) * 2, 2, 0.25);
  }
  return band.song;
}

/** Salsa: clave 2-3, tumbao of the bass before the beat, montuno of the piano, bell on the beats. */
function salsa(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(ANDALUSIAN, Math.floor(bar / 2));
    for (const beat of bar % 2 === 0 ? [1, 2] : [0, 1.5, 3]) band.noise(4 * bar + beat, 0.5, 90);
    for (const beat of [1.5, 3]) band.note(4 * bar + beat, root + (beat === 3 ? 7 : 0), 0.9, 0.7);
    for (const beat of bar % 2 === 0 ? [0, 1, 1.5, 2.5, 3.5] : [0.5, 1.5, 2.5, 3.5])
      band.chord(4 * bar + beat, chord, 0.35, 0.2);
    for (let beat = 0; beat < 4; beat++) {
      band.noise(4 * bar + beat, 0.3, 30);
      band.noise(4 * bar + beat + 0.5, 0.12, 60);
    }
  }
  return band.song;
}

/** Bass drum and snare together on three, chords on the offbeats. */
function reggae(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(ANDALUSIAN, bar);
    band.drum(4 * bar + 2, 0.9);
    band.noise(4 * bar + 2, 0.5, 25);
    for (let beat = 0; beat < 4; beat++) {
      band.chord(4 * bar + beat + 0.5, chord, 0.25, 0.25);
      band.noise(4 * bar + beat, 0.15, 80);
      band.noise(4 * bar + beat + 0.5, 0.1, 80);
    }
    for (const beat of [0.5, 1, 2.5, 3]) band.note(4 * bar + beat, root, 0.4, 0.6);
  }
  return band.song;
}

/** Four bass drums a bar, open hi-hat between them, octaves of the bass. */
function disco(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(CIRCLE, bar);
    for (let beat = 0; beat < 4; beat++) {
      band.drum(4 * bar + beat, 0.9);
      band.noise(4 * bar + beat + 0.5, 0.3, 25);
      if (beat % 2 === 1) band.noise(4 * bar + beat, 0.5, 20);
      band.note(4 * bar + beat, root, 0.4, 0.4);
      band.note(4 * bar + beat + 0.5, root + 12, 0.4, 0.3);
    }
    band.chord(4 * bar, chord, 3.5, 0.12);
  }
  return band.song;
}

/** Habanera of the bass, chords on all four, no drums. */
function tango(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(ANDALUSIAN, bar);
    for (const beat of [0, 1.5, 2, 3]) band.note(4 * bar + beat, root + 12, 0.5, beat === 0 ? 0.8 : 0.5);
    for (let beat = 0; beat < 4; beat++) band.chord(4 * bar + beat, chord, 0.3, beat === 0 ? 0.3 : 0.2);
  }
  return band.song;
}

/** Drums of rock, eighths of the guitar. */
function rock(bpm: number, seed: number): Float32Array {
  const band = new Band(bpm, seed);
  for (let bar = 0; bar < band.bars(4); bar++) {
    const [root, chord] = at(CIRCLE, bar);
    for (const beat of [0, 2, 2.5]) band.drum(4 * bar + beat, 0.9);
    for (const beat of [1, 3]) band.noise(4 * bar + beat, 0.7, 18);
    for (let half = 0; half < 8; half++) {
      band.noise(4 * bar + half / 2, 0.2, 70);
      band.chord(4 * bar + half / 2, [root + 12, chord[0]!], 0.4, half === 0 ? 0.35 : 0.2);
    }
  }
  return band.song;
}

/** A style at a tempo that it is played at, and the beats of its bar. */
export interface Style {
  readonly name: string;
  readonly bpm: number;
  readonly beatsPerBar: 3 | 4;
  readonly play: (seed: number) => Float32Array;
}

const style = (
  name: string,
  bpm: number,
  beatsPerBar: 3 | 4,
  play: (bpm: number, seed: number) => Float32Array,
): Style => ({ name, bpm, beatsPerBar, play: (seed) => play(bpm, seed) });

export const STYLES: readonly Style[] = [
  style('ragtime', 144, 4, ragtime),
  style('ragtime', 112, 4, ragtime),
  style('jazz waltz', 152, 3, jazzWaltz),
  style('jazz waltz', 118, 3, jazzWaltz),
  style('slow waltz', 86, 3, slowWaltz),
  style('slow waltz', 104, 3, slowWaltz),
  style('salsa', 96, 4, salsa),
  style('salsa', 108, 4, salsa),
  style('reggae', 76, 4, reggae),
  style('disco', 119, 4, disco),
  style('disco', 129, 4, disco),
  style('tango', 124, 4, tango),
  style('rock', 138, 4, rock),
  style('rock', 92, 4, rock),
];
