import { expect, it } from 'vitest';
import { musicFeatures } from '../../../../web/audio/features';
import { rhythmOf } from '../../../../web/audio/rhythm/rhythm';
import { recipe } from '../../support/audio/audio-fixtures';
import { BEGIN, STYLES } from '../../support/audio/styles';

/** Tempo up to which the beats of half the length may be heard as the beat. */
const MAY_BE_DOUBLED = 100;

/** Styles whose bars are found. Ragtime of 112 BPM, jazz waltz, salsa and reggae have theirs elsewhere. */
const BARS_FOUND = ['slow waltz', 'disco', 'tango', 'rock'];

it.each(STYLES.map((style) => [style.name, style.bpm, style] as const))(
  'a %s of %f BPM has its tempo and its metre',
  (name, bpm, { beatsPerBar, play }) => {
    const rhythm = rhythmOf(musicFeatures(play(1), recipe).features, recipe);
    const speed = bpm < MAY_BE_DOUBLED && rhythm.tempo > 1.5 * bpm ? 2 : 1;
    expect(rhythm.tempo / speed / bpm).toBeCloseTo(1, 2);
    expect(rhythm.beatsPerBar).toBe(beatsPerBar);
    expect(rhythm.sure).toBe(true);
    const bar = ((rhythm.beats[rhythm.first]! - BEGIN) * bpm) / 60 / beatsPerBar;
    if (BARS_FOUND.includes(name)) expect(Math.abs(bar - Math.round(bar))).toBeLessThan(0.03);
  },
);
