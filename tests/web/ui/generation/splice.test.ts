import { expect, test } from 'vitest';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { splice } from '../../../../web/ui/generation/splice';
import { maxDifference } from '../../support/open-model';

/** A dancer who stands at x, with all joints rotated by one angle about y. */
function stander(x: number, angle: number, frames = 60): SolvedMotion {
  const offsets = Float32Array.from({ length: 66 }, (_, i) => (i < 3 ? 0 : ((i * 7) % 5) / 20));
  const root = Float32Array.from({ length: frames * 3 }, (_, i) => (i % 3 === 0 ? x : 1));
  const rotations = Float32Array.from({ length: frames * 88 }, (_, i) =>
    i % 4 === 1 ? Math.sin(angle / 2) : i % 4 === 3 ? Math.cos(angle / 2) : 0,
  );
  const positions = forwardKinematics(offsets, root, rotations);
  return { fps: 30, frames, offsets, root, rotations, positions, fitError: 0 };
}

test('only the fresh frames change, crossfaded at both ends, and bones keep their length', () => {
  const [shown, made] = [stander(0, 0), stander(1, 1)];
  const { root, rotations, positions } = splice(shown, made, { from: 20, to: 40 });
  const x = (frame: number): number => root[frame * 3] ?? NaN;
  expect([x(0), x(19), x(40), x(59)]).toEqual([0, 0, 0, 0]);
  expect(x(30)).toBe(1);
  const steps = Array.from({ length: 59 }, (_, frame) => Math.abs(x(frame + 1) - x(frame)));
  expect(Math.max(...steps)).toBeLessThan(0.15);
  expect(maxDifference(positions, forwardKinematics(shown.offsets, root, rotations))).toBeLessThan(1e-5);
  expect(positions.subarray(0, 20 * 66)).toEqual(shown.positions.subarray(0, 20 * 66));
});

test('there is no crossfade at the start and the end of the dance', () => {
  const { root } = splice(stander(0, 0), stander(1, 1), { from: 0, to: 60 });
  expect(root).toEqual(stander(1, 1).root);
});
