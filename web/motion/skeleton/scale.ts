import type { MotionClip } from './clip';
import { J, JOINT_COUNT } from './skeleton';
import { median } from '../math/statistics';
import { distance, readVec } from '../math/vec3';

const SPINE = [J.pelvis, J.spine1, J.spine2, J.spine3, J.neck, J.head];
const LEGS = [
  [J.left_hip, J.left_knee, J.left_ankle],
  [J.right_hip, J.right_knee, J.right_ankle],
];

/**
 * Body height: length of leg plus spine in metres, by which dancers are scaled to one another. The median over frames
 * of the mean leg (hip, knee, ankle) plus the chain from pelvis to head. It does not depend on the pose, unlike the
 * height of the head above the floor. The same measure as `body_height` of the training side.
 */
export function bodyHeight(clip: MotionClip): number {
  const heights = new Float64Array(clip.frames);
  for (let frame = 0; frame < clip.frames; frame++) {
    const chain = (joints: readonly number[]): number => {
      let sum = 0;
      for (let i = 1; i < joints.length; i++) {
        const a = readVec(clip.positions, frame * JOINT_COUNT + joints[i - 1]!);
        sum += distance(a, readVec(clip.positions, frame * JOINT_COUNT + joints[i]!));
      }
      return sum;
    };
    const legs = LEGS.reduce((sum, leg) => sum + chain(leg), 0) / LEGS.length;
    heights[frame] = legs + chain(SPINE);
  }
  return median(heights);
}
