import { expect, it } from 'vitest';
import { aboutAxis, rotate } from '../../../../web/motion/math/quat';
import { dot, type Vec3, writeVec, X_AXIS } from '../../../../web/motion/math/vec3';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';
import { uprightOf } from '../../../../web/video/world/ground';
import { L } from '../../../../web/video/pose/landmark-names';

/** A dancer on one leg who bends far to one side, the other leg stretched out; metres, y up, feet at the origin. */
const BALANCE: readonly (readonly [number, Vec3])[] = [
  [L.left_ankle, [0, 0.08, 0]],
  [L.right_ankle, [0.75, 0.5, 0]],
  [L.left_hip, [0.1, 0.85, 0]],
  [L.right_hip, [0.22, 0.95, 0]],
  [L.left_shoulder, [-0.35, 1.0, 0]],
  [L.right_shoulder, [-0.15, 1.3, 0]],
];

it('has a dancer upright who bends to the side on one leg, for every tilt of the camera', () => {
  for (const tilt of [-0.5, 0, 0.5]) {
    // The camera's axes have y down.
    const inCamera = (v: Vec3): Vec3 => rotate(aboutAxis(X_AXIS, Math.PI + tilt), v);
    const world = new Float64Array(LANDMARK_COUNT * 3);
    for (const [landmark, place] of BALANCE) writeVec(world, landmark, inCamera(place));
    const cosine = dot(uprightOf(world, 1), inCamera([0, 1, 0]));
    expect((180 / Math.PI) * Math.acos(cosine)).toBeLessThan(6);
  }
});
