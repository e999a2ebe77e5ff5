import { describe, expect, it } from 'vitest';
import { bodyHeight } from '../../../../web/motion/skeleton/scale';
import { median } from '../../../../web/motion/math/statistics';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import type { Observations } from '../../../../web/video/observations';
import { reconstruct, STATURE } from '../../../../web/video/world/reconstruct';
import { checkSeen } from '../../../../web/video/checks';
import { confidenceOf } from '../../../../web/video/world/advice';
import { projected, type Camera } from '../../support/filmed/projected';
import { walker } from '../../support/filmed/walker';

const CAMERA: Camera = { width: 640, height: 480, focal: 560, position: [0, 1.3, 4], pitch: 0.1 };
const truth = walker({ seconds: 4, turn: 0.4, distance: 0.8 });
const height = STATURE * bodyHeight(truth);

function solved(observations: Observations) {
  return reconstruct(observations, { height, focal: CAMERA.focal / CAMERA.width, trim: null });
}

/** Mean distance of the joints with both pelvises in one place, metres. */
function meanError({ motion, series }: ReturnType<typeof solved>): number {
  let sum = 0;
  const first = Math.round(series.start * 30);
  for (let frame = 0; frame < motion.frames; frame++)
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const [a, b] = [frame * JOINT_COUNT, (first + frame) * JOINT_COUNT];
      const d = [0, 1, 2].map(
        (axis) =>
          motion.positions[3 * (a + joint) + axis]! -
          motion.positions[3 * (a + J.pelvis) + axis]! -
          truth.positions[3 * (b + joint) + axis]! +
          truth.positions[3 * (b + J.pelvis) + axis]!,
      );
      sum += Math.hypot(...d);
    }
  return sum / (motion.frames * JOINT_COUNT);
}

describe('a motion from projections of a known one', () => {
  it('is that motion', () => {
    const result = solved(projected(truth, CAMERA, 0));
    expect(result.motion.frames).toBe(truth.frames);
    expect(meanError(result)).toBeLessThan(0.05);
  });

  it('is near it with noise of 3 cm on every landmark', () => {
    expect(meanError(solved(projected(truth, CAMERA, 0.03)))).toBeLessThan(0.07);
  });

  it('is as far from the camera as the dancer was', () => {
    const seen = projected(truth, CAMERA, 0);
    const result = solved(seen);
    const away = Array.from(
      { length: truth.frames },
      (_, t) => 4 - truth.positions[3 * JOINT_COUNT * t + 2]!,
    );
    expect(Math.abs(result.distance - median(away))).toBeLessThan(0.2);
    // A lens of half the length sees the same from half as far.
    const wide = reconstruct(seen, { height, focal: CAMERA.focal / CAMERA.width / 2, trim: null });
    expect(Math.abs(wide.distance - result.distance / 2)).toBeLessThan(0.2);
  });

  it('walks as far as the dancer did', () => {
    const { motion } = solved(projected(truth, CAMERA, 0.01));
    const far = (positions: Float32Array): number => {
      const z = Array.from({ length: truth.frames }, (_, frame) => positions[frame * JOINT_COUNT * 3 + 2]!);
      return Math.max(...z) - Math.min(...z);
    };
    expect(Math.abs(far(motion.positions) - far(truth.positions))).toBeLessThan(0.15 * 1.6);
  });

  it('has the flips undone that a network makes in turns', () => {
    const seen = projected(truth, CAMERA, 0.01);
    const flipped = projected(truth, CAMERA, 0.01, { from: 50, to: 62 });
    expect(solved(flipped).flipped).toBe(12);
    expect(Math.abs(meanError(solved(flipped)) - meanError(solved(seen)))).toBeLessThan(0.01);
  });

  it('is not thrown off by pictures in which all is seen at one point', () => {
    const seen = projected(truth, CAMERA, 0.01);
    for (const frame of [40, 41, 80]) seen.image.fill(9, frame * 66, (frame + 1) * 66);
    const { motion } = solved(seen);
    expect(motion.positions.every(Number.isFinite)).toBe(true);
    const lasting = solved(projected(truth, CAMERA, 0.01)).motion;
    const apart = motion.root.map((value, i) => Math.abs(value - lasting.root[i]!));
    expect(apart.subarray(0, 3 * 30).reduce((most, one) => Math.max(most, one), 0)).toBeLessThan(0.1);
  });

  it('bridges a gap, marks it and says where it is', () => {
    const seen = projected(truth, CAMERA, 0.01);
    seen.presence.fill(0, 40, 50);
    const { series } = solved(seen);
    expect(series.gaps).toHaveLength(1);
    expect(series.gaps[0]!.end - series.gaps[0]!.start).toBeCloseTo(10 / 30, 1);
    expect([...confidenceOf(series)].filter((value) => value === 0)).toHaveLength(10);
  });
});

describe('what was seen', () => {
  const refused = (change: (seen: Observations) => Observations): string => {
    try {
      checkSeen(change(projected(truth, CAMERA, 0)));
    } catch (error) {
      return (error as { code: string }).code;
    }
    return 'accepted';
  };

  it('is accepted, or refused with a sentence', () => {
    expect(refused((seen) => seen)).toBe('accepted');
    expect(refused((seen) => ({ ...seen, presence: seen.presence.map(() => 0) }))).toBe('no-person');
    expect(refused((seen) => ({ ...seen, presence: seen.presence.map(() => 0), brightest: 0.01 }))).toBe(
      'video-black',
    );
    expect(refused((seen) => ({ ...seen, visibility: seen.visibility.map(() => 0.1) }))).toBe('half-a-body');
    // Twice a moment, a second and more apart.
    const moments = (row: number): boolean => (row >= 5 && row < 7) || (row >= 50 && row < 54);
    expect(
      refused((seen) => ({
        ...seen,
        presence: seen.presence.map((value, row) => (moments(row) ? value : 0)),
      })),
    ).toBe('video-too-short');
    expect(refused((seen) => ({ ...seen, times: seen.times.map((time) => time / 10) }))).toBe(
      'video-too-short',
    );
  });
});
