import { describe, expect, it } from 'vitest';
import { bestShift } from '../../../../web/motion/beats/beat-match';
import { motionBeats } from '../../../../web/motion/beats/motion-beats';
import { small } from '../../support/small-manifest';

const { smoothing, tolerance } = small.quality.beats;
/** The shift where it is clearly better, else null. */
const betterShift = (beats: readonly number[], music: readonly number[]) => {
  const best = bestShift(beats, music, tolerance);
  return best?.clear ? best : null;
};

/**
 * A leader of one joint that swings once in `period` frames: it stands still twice as often, never midway between two
 * frames, where two speeds would be equal.
 */
function swinging(frames: number, period: number): { positions: Float32Array; frames: number } {
  const positions = new Float32Array(frames * 3);
  for (let frame = 0; frame < frames; frame++)
    positions[frame * 3] = Math.cos((2 * Math.PI * (frame + 0.3)) / period);
  return { positions, frames };
}

/** A click every `every` frames from `first` on. */
const clicks = (first: number, every: number, frames: number): number[] =>
  Array.from({ length: Math.ceil((frames - first) / every) }, (_, index) => first + index * every);

describe('the best shift of the music', () => {
  const frames = 600;
  const leader = motionBeats(swinging(frames, 40), smoothing);
  const [still = 0] = leader;

  it('is the one that a click track was moved by, in either direction', () => {
    expect(leader.length).toBeGreaterThan(20);
    for (const by of [-7, -4, 4, 7, 9]) {
      const found = betterShift(leader, clicks(still - by, 20, frames));
      expect(found?.by).toBe(by);
      expect(found?.score).toBeGreaterThan(0.95);
      expect(found?.before).toBeLessThan(found?.score ?? 0);
    }
  });

  it('is found among large shifts where the beats are irregular', () => {
    const beats = [20, 47, 69, 110, 128, 171, 195, 240, 262, 303, 333, 350, 391, 420];
    for (const by of [-50, 23, 60])
      expect(
        betterShift(
          beats,
          beats.map((beat) => beat - by),
        )?.by,
      ).toBe(by);
  });

  it('is found where the song is much shorter than the dance', () => {
    const found = betterShift(leader, clicks(still - 7, 20, frames / 3));
    expect(found?.by).toBe(7);
    expect(found?.score).toBeGreaterThan(0.9);
  });

  it('is the smaller of two that are as good but for one beat', () => {
    const beats = clicks(0, 20, 1200);
    // Four frames later all beats fit but the first, sixteen frames earlier all.
    const music = [2, ...clicks(16, 20, 1220)];
    expect(bestShift(beats, music, tolerance)?.by).toBe(4);
  });

  it('is none where the beats align already, within a frame', () => {
    expect(betterShift(leader, clicks(still, 20, frames))).toBeNull();
    expect(betterShift(leader, clicks(still + 1, 20, frames))).toBeNull();
  });

  it('is none where nothing fits, and with too few beats', () => {
    const unrelated = [13, 31, 64, 71, 102, 137, 149, 184, 203, 241, 249, 283, 320, 331, 367, 402, 411, 449];
    const best = bestShift(unrelated, clicks(0, 17, 460), tolerance);
    expect(best).toMatchObject({ clear: false });
    expect(best?.score).toBeGreaterThanOrEqual(best?.before ?? 1);
    expect(bestShift(leader, [1, 2, 3], tolerance)).toBeNull();
    expect(bestShift(leader, clicks(still, 120, frames).slice(0, 5), tolerance)).toBeNull();
    expect(bestShift([], clicks(0, 20, frames), tolerance)).toBeNull();
  });
});
