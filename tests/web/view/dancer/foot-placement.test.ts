import { Matrix4, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { LEGS } from '../../../../web/motion/skeleton/limbs';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { ballHeight, footMatrix, heelHeight } from '../../../../web/view/dancer/foot-placement';
import { person } from '../../support/skeletons';

const offsets = person();
/** Joints of a person in the T-pose whose soles are at a height, metres. */
function standing(height: number): Float32Array {
  const rotations = Float32Array.from({ length: JOINT_COUNT * 4 }, (_, i) => (i % 4 === 3 ? 1 : 0));
  const joints = forwardKinematics(offsets, new Float32Array(3), rotations);
  const lift = height - ballHeight(joints, LEGS[0]!);
  return joints.map((value, i) => (i % 3 === 1 ? value + lift : value));
}

it('soles of flat feet are as high under the heels as under the balls', () => {
  for (const height of [0, 0.2])
    for (const foot of LEGS) {
      expect(ballHeight(standing(height), foot)).toBeCloseTo(height, 5);
      expect(heelHeight(standing(height), offsets, foot)).toBeCloseTo(height, 5);
    }
});

it('what lies under a foot points where the foot does', () => {
  const joints = standing(0);
  joints.set([1, 0.1, 2], J.left_ankle * 3);
  joints.set([1.1, 0.03, 2], J.left_foot * 3);
  const matrix = footMatrix(joints, LEGS[0]!, 0.5, 0.01, new Matrix4());
  expect(new Vector3(0, 0, 0).applyMatrix4(matrix).toArray()).toEqual([
    expect.closeTo(1.05, 5),
    0.01,
    expect.closeTo(2, 5),
  ]);
  expect(new Vector3(0, 0, 1).transformDirection(matrix).x).toBeCloseTo(1, 5);
});
