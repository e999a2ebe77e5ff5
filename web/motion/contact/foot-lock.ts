import type { SolvedMotion } from '../skeleton/clip';
import { type ContactInterval, contactIntervals } from './foot-contacts';
import { contactWeights, footShift } from './least-squares-shift';
import { separateLegs } from './leg-separation';
import { withShiftedFeet } from './shifted-limb';

/** What is held, and how firmly. */
interface HoldOptions {
  /** When an ankle or a toe is in contact with the floor. */
  readonly contacts: (joint: number) => readonly ContactInterval[];
  /** Weight of a slide; without it that of `contactWeights`. */
  readonly weight?: number;
}

/**
 * Foot lock: the motion with feet that do not slide while they are in contact.
 *
 * Each foot is shifted level with the floor and keeps its rotation, so that heel and ball still roll and pivot; thigh and
 * shin follow by two-bone inverse kinematics. Joints above the knees do not move. Bone lengths stay, rotations stay
 * continuous, and positions are again the forward kinematics of the rotations. `fitError` remains that of the fit
 * before. Pure.
 *
 * @param hold without it contacts are found in the motion
 */
export function lockFeet(
  motion: SolvedMotion,
  { contacts, weight }: HoldOptions = { contacts: (joint) => contactIntervals(motion, joint) },
): SolvedMotion {
  const weights = (joint: number): Float64Array => contactWeights(motion.frames, contacts(joint), weight);
  return withShiftedFeet(motion, (leg) => footShift(motion, leg, { weights }));
}

/**
 * The motion with foot lock: feet in contact stay, and legs that this brings together, to where feet stand in each other's
 * way, are apart again. Pure.
 */
export function withFootLock(motion: SolvedMotion): SolvedMotion {
  return separateLegs(lockFeet(motion));
}
