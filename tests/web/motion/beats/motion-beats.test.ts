import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { beatScores } from '../../../../web/motion/beats/beat-match';
import { motionBeats } from '../../../../web/motion/beats/motion-beats';
import { small } from '../../support/small-manifest';

const { smoothing, tolerance } = small.quality.beats;
const golden = JSON.parse(
  readFileSync(new URL('../../../fixtures/motion-beats.json', import.meta.url), 'utf8'),
) as { frames: number; positions: number[]; beats: number[]; music: number[]; scores: number[] }[];

describe('motion beats', () => {
  for (const { frames, positions, beats, music, scores } of golden) {
    it(`are those of Python in ${frames} frames`, () => {
      const metres = Float32Array.from(positions, (value) => value / 4096);
      expect(motionBeats({ positions: metres, frames }, smoothing)).toEqual(beats);
    });

    it(`align with the music as in Python in ${frames} frames`, () => {
      const ours = beatScores(beats, music, tolerance);
      expect(ours).toHaveLength(scores.length);
      ours.forEach((score, index) => expect(score).toBeCloseTo(scores[index] ?? NaN, 9));
    });
  }

  it('do not exist where nobody moves and in clips of less than two frames', () => {
    expect(motionBeats({ positions: new Float32Array(90 * 66), frames: 90 }, smoothing)).toEqual([]);
    expect(motionBeats({ positions: new Float32Array(66), frames: 1 }, smoothing)).toEqual([]);
    expect(motionBeats({ positions: new Float32Array(0), frames: 0 }, smoothing)).toEqual([]);
  });

  it('are where the speed is lower than before and after, not where it stays as low', () => {
    const beatsAt = (speeds: readonly number[]): number[] => {
      const places = speeds.reduce((path, speed) => [...path, path.at(-1)! + speed], [0]);
      const positions = Float32Array.from(places.flatMap((x) => [x, 0, 0]));
      return motionBeats({ positions, frames: places.length }, 0.01);
    };
    expect(beatsAt([4, 2, 1, 2, 4])).toEqual([2]);
    expect(beatsAt([4, 1, 1, 4])).toEqual([]);
    expect(beatsAt([4, 2, 1])).toEqual([]);
  });

  it('score 0 without music', () => {
    expect(beatScores([3, 7], [], tolerance)).toEqual([0, 0]);
  });
});
