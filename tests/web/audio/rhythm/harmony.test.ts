import { expect, it } from 'vitest';
import { harmonyChanges } from '../../../../web/audio/rhythm/harmony';

it('a change of harmony is at the first beat of the new chord alone, over as many beats before as after', () => {
  // Eight beats of ten frames: two of one chord, two of another, four of the first again.
  const chordOf = (frame: number): number => (frame >= 20 && frame < 40 ? 1 : 0);
  const chroma = Float64Array.from({ length: 160 }, (_, i) => (i % 2 === chordOf(i >> 1) ? 1 : 0));
  const onset = new Float64Array(80);
  const accents = { framesPerSecond: 30, onset, bass: onset, chroma };
  const beats = Array.from({ length: 8 }, (_, beat) => beat * 10);
  const between = 1 - Math.SQRT1_2;
  const expected = [0, between, 1, 0, 1, between, 0, 0];
  harmonyChanges(beats, accents, 2).forEach((change, beat) => {
    expect(change, `beat ${beat}`).toBeCloseTo(expected[beat]!, 6);
  });
});
