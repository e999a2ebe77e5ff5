import { SMPL_NAMES } from './arrays';
import type { BodyNames } from '../made-bvh';
import { inFile, madeMotion, type MadeMotion } from './made-motion';
import { BALL_SHARE, HEAD_SHARE, NECK_UP } from '../../../../web/motion/skeleton/landmarks';
import { add, lerp, type Vec3 } from '../../../../web/motion/math/vec3';

export const seen: MadeMotion = madeMotion({ names: SMPL_NAMES });
/** What of the made motion is compared: joints that are not estimated from points seen in pictures. */
type Seen = Pick<MadeMotion, 'names' | 'joints' | 'places'>;
const NAMES: BodyNames = {
  root: 'pelvis',
  spine: [],
  sides: ['left', 'right'],
  head: 'head',
  hip: '*_hip',
  knee: '*_knee',
  ankle: '*_ankle',
  shoulder: '*_shoulder',
  elbow: '*_elbow',
  wrist: '*_wrist',
};
export const seenWithoutToes: Seen = { ...seen, names: NAMES };
export const seenParts: Seen = { ...seen, names: { ...NAMES, toe: '*_foot' } };

/**
 * A point of the made body that a detector of poses would see: ears, nose, the top of the head and the tips of the toes
 * where they must be for the joints to be where they are; other names are those of joints.
 */
function pointOf(name: string, frame: number): Vec3 {
  const joint = (wanted: string): Vec3 =>
    seen.places[frame]![seen.joints.findIndex((one) => one.name === wanted)]!;
  const middle = (part: string): Vec3 => lerp(joint(`left_${part}`), joint(`right_${part}`), 0.5);
  const neck = lerp(middle('hip'), middle('shoulder'), NECK_UP);
  const ears = lerp(neck, joint('head'), 1 / HEAD_SHARE);
  const [side] = name.split('_') as [string];
  if (/toe|foot_index/.test(name)) return lerp(joint(`${side}_ankle`), joint(`${side}_foot`), 1 / BALL_SHARE);
  if (name.endsWith('ear')) return add(ears, [side === 'left' ? 0.07 : -0.07, 0, 0]);
  if (name === 'top') return lerp(neck, ears, 2);
  if (name === 'middle') return middle('hip');
  if (/eye|nose|mouth/.test(name)) return add(ears, [name.startsWith('left') ? 0.03 : -0.03, 0.02, 0.1]);
  return joint(name);
}

/** Points by frame in a file's unit and axes; null for a point that nobody looks at. */
export function rowsOf(
  points: readonly (string | null)[],
  unitsPerMetre = 1,
  up: 'y' | 'z' = 'y',
): (readonly Vec3[])[] {
  return Array.from({ length: seen.frames }, (_, frame) =>
    points.map((name) =>
      name === null ? ([0, 0, 0] as const) : inFile(pointOf(name, frame), unitsPerMetre, up),
    ),
  );
}
