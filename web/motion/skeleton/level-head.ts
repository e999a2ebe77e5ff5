import type { SolvedMotion } from './clip';
import { J, JOINT_COUNT, PARENTS } from './skeleton';
import {
  aboutAxis,
  conjugate,
  IDENTITY,
  multiply,
  negate,
  type Quat,
  readQuat,
  rotate,
  writeQuat,
} from '../math/quat';
import { length, scale, smoothstep, type Vec3 } from '../math/vec3';

/** Share of a small tilt of the head against the horizon that is taken back, and the greatest angle, radians. */
const LEVEL_SHARE = 0.85;
const MAX_LEVEL = 0.6;

/** An angle's share as long as it is small, and never more than `max`. */
export const limited = (angle: number, max: number): number => max * Math.tanh(angle / max);

/**
 * A head held level. Joint positions do not show how a head turns: the fit turns it with the neck, so that whoever leans
 * back would look at the ceiling.
 * @param head its rotation in the world
 */
export function levelled(head: Quat): Quat {
  const [x, , z] = rotate(head, [0, 0, 1]);
  // Rotation from the head as it is to the same heading without pitch and roll.
  let turn = multiply(aboutAxis([0, 1, 0], Math.atan2(x, z)), conjugate(head));
  if (turn[3] < 0) turn = negate(turn);
  const axis: Vec3 = [turn[0], turn[1], turn[2]];
  const sine = length(axis);
  if (sine < 1e-6) return head;
  const tilt = 2 * Math.atan2(sine, turn[3]);
  // A head that looks straight up or down has no heading.
  const angle = limited(LEVEL_SHARE * tilt, MAX_LEVEL) * smoothstep(0.2, 0.6, Math.hypot(x, z));
  return multiply(aboutAxis(scale(axis, 1 / sine), angle), head);
}

/** The motion with the head held level, as it is drawn. Heads end their chains, so no joint moves. Pure. */
export function withLevelHead(motion: SolvedMotion): SolvedMotion {
  const rotations = motion.rotations.slice();
  for (let frame = 0; frame < motion.frames; frame++) {
    const row = frame * JOINT_COUNT;
    let neck = IDENTITY;
    for (let joint = PARENTS[J.head]!; joint >= 0; joint = PARENTS[joint]!)
      neck = multiply(readQuat(motion.rotations, row + joint), neck);
    const head = levelled(multiply(neck, readQuat(motion.rotations, row + J.head)));
    writeQuat(rotations, row + J.head, multiply(conjugate(neck), head));
  }
  return { ...motion, rotations };
}
