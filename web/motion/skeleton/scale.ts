import type { MotionClip } from './clip';
import { LEGS } from './limbs';
import { J, JOINT_COUNT } from './skeleton';
import { rowDistance } from '../math/rows';
import { median } from '../math/statistics';

const SPINE = [J.pelvis, J.spine1, J.spine2, J.spine3, J.neck, J.head];

/**
 * Body height: length of leg plus spine in metres, by which dancers are scaled to one another. The median over frames
 * of the mean leg (hip, knee, ankle) plus the chain from pelvis to head. It does not depend on the pose, unlike the
 * height of the head above the floor. The same measure as `body_height` of the training side.
 */
export function bodyHeight(clip: MotionClip): number {
  const { positions, frames } = clip;
  const chain = (joints: readonly number[], frame: number): number => {
    const row = frame * JOINT_COUNT;
    let sum = 0;
    for (let i = 1; i < joints.length; i++)
      sum += rowDistance(positions, row + joints[i - 1]!, positions, row + joints[i]!);
    return sum;
  };
  const heights = new Float64Array(frames);
  for (let frame = 0; frame < frames; frame++) {
    const legs =
      LEGS.reduce((sum, { start, middle, end }) => sum + chain([start, middle, end], frame), 0) / LEGS.length;
    heights[frame] = legs + chain(SPINE, frame);
  }
  return median(heights);
}
