import type { SolvedMotion } from '../skeleton/clip';
import { leastSquaresShift, type Track } from './least-squares-shift';
import { separateLegs } from './leg-separation';
import { LEGS, type LegJoints } from '../skeleton/limbs';
import { bonesAt, shiftFoot } from './shifted-limb';
import { maxLimbLength } from './two-bone-ik';
import { type ContactInterval, contactIntervals } from './foot-contacts';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { add, type Vec3, writeVec } from '../math/vec3';

/** Passes of iteratively reweighted least squares. */
const PASSES = 3;
/** By how much a leg may be too short for a shift before the weight of a shift of zero doubles, metres. */
const SHORTFALL = 0.002;

/** What is held, and how firmly. */
interface HoldOptions {
  /** When an ankle or a toe is in contact with the floor. */
  readonly contacts: (joint: number) => readonly ContactInterval[];
  /** Weight of a slide; without it that of `leastSquaresShift`. */
  readonly weight?: number;
}

/** Where the ankle is from the hip, frames x 3 metres, and how far from it the leg reaches, metres. */
function legReach(motion: SolvedMotion, leg: LegJoints): Record<'ankles' | 'reach', Float64Array> {
  const ankles = new Float64Array(3 * motion.frames);
  const reach = new Float64Array(motion.frames);
  for (let t = 0; t < motion.frames; t++) {
    const { upper, lower } = bonesAt(motion.positions, leg, t);
    writeVec(ankles, t, add(upper, lower));
    reach[t] = maxLimbLength(upper, lower);
  }
  return { ankles, reach };
}

/**
 * The shift that keeps a foot in place while it is in contact, along both axes of the floor, one number a frame, metres.
 * Each pass raises the weight of a shift of zero where the pass before asked for more than the leg reaches.
 */
function shiftOf(
  motion: SolvedMotion,
  joints: LegJoints,
  { contacts, weight }: HoldOptions,
): { x: Float64Array; z: Float64Array } {
  const { frames, positions } = motion;
  const feet = [joints.end, joints.toe].map((joint) => ({
    joint,
    contacts: contacts(joint),
  }));
  const tracks = (axis: 0 | 2): Track[] =>
    feet.map(({ joint, contacts }) => ({
      contacts,
      positions: Float64Array.from(
        { length: frames },
        (_, t) => positions[(t * JOINT_COUNT + joint) * 3 + axis]!,
      ),
    }));
  const [along, across] = [tracks(0), tracks(2)];
  const { ankles, reach } = legReach(motion, joints);
  const zeroWeights = new Float64Array(frames).fill(1);
  const held = (some: readonly Track[]): Float64Array => leastSquaresShift(some, zeroWeights, weight);
  let [x, z] = [held(along), held(across)];
  for (let pass = 1; pass < PASSES; pass++) {
    for (let t = 0; t < frames; t++) {
      const ax = ankles[3 * t]! + x[t]!;
      const ay = ankles[3 * t + 1]!;
      const az = ankles[3 * t + 2]! + z[t]!;
      const shortfall = Math.max(0, Math.sqrt(ax * ax + ay * ay + az * az) - reach[t]!);
      zeroWeights[t]! *= 1 + shortfall / SHORTFALL;
    }
    [x, z] = [held(along), held(across)];
  }
  return { x, z };
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
  hold: HoldOptions = { contacts: (joint) => contactIntervals(motion, joint) },
): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  for (const joints of LEGS) {
    const { x, z } = shiftOf(motion, joints, hold);
    for (let frame = 0; frame < motion.frames; frame++) {
      const shift: Vec3 = [x[frame]!, 0, z[frame]!];
      shiftFoot(motion, joints, frame, { ankle: shift, toe: shift }, { rotations, positions });
    }
  }
  return { ...motion, rotations, positions };
}

/** The motion with foot lock: legs that it brings together, to where feet stand in each other's way, are apart again. Pure. */
export function withFootLock(motion: SolvedMotion): SolvedMotion {
  return separateLegs(lockFeet(motion));
}
