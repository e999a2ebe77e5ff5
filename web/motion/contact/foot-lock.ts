import type { SolvedMotion } from '../skeleton/clip';
import { leastSquaresShift, type Track } from './least-squares-shift';
import { type Leg, twoBoneIk, maxLegLength } from './two-bone-ik';
import { contactIntervals } from './foot-contacts';
import { conjugate, multiply, type Quat, readQuat, rotate, writeQuat } from '../math/quat';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { add, readVec, sub, type Vec3, writeVec, X_AXIS } from '../math/vec3';

/** Joint indices of a leg. */
interface LegJoints {
  readonly hip: number;
  readonly knee: number;
  readonly ankle: number;
  readonly toe: number;
}

const LEGS: readonly LegJoints[] = [
  { hip: J.left_hip, knee: J.left_knee, ankle: J.left_ankle, toe: J.left_foot },
  { hip: J.right_hip, knee: J.right_knee, ankle: J.right_ankle, toe: J.right_foot },
];

/** Shift above which its own weight grows, metres: a foot that would be moved farther is released gradually. */
const MAX_SHIFT = 0.1;
/** Passes of iteratively reweighted least squares. */
const PASSES = 6;
/** By how much a leg may be too short for a shift before the weight of a shift of zero doubles, metres. */
const SHORTFALL = 0.002;

/** The leg of one frame, and the rotations of its bones, both in world axes. */
function legAt(
  motion: SolvedMotion,
  joints: LegJoints,
  frame: number,
): { leg: Leg; thigh: Quat; shin: Quat; foot: Quat } {
  const at = (joint: number): Vec3 => readVec(motion.positions, frame * JOINT_COUNT + joint);
  const turn = (joint: number): Quat => readQuat(motion.rotations, frame * JOINT_COUNT + joint);
  const thigh = multiply(turn(J.pelvis), turn(joints.hip));
  const shin = multiply(thigh, turn(joints.knee));
  const foot = multiply(shin, turn(joints.ankle));
  const [hip, knee, ankle] = [at(joints.hip), at(joints.knee), at(joints.ankle)];
  // In the rest pose knees bend about x.
  const leg = { hip, thigh: sub(knee, hip), shin: sub(ankle, knee), hinge: rotate(thigh, X_AXIS) };
  return { leg, thigh, shin, foot };
}

/**
 * The shift that keeps a foot in place while it is in contact: one vector level with the floor a frame, metres. Each pass
 * raises the weight of a shift of zero where the pass before asked for too much.
 */
function shiftsOf(motion: SolvedMotion, joints: LegJoints, legs: readonly Leg[]): Vec3[] {
  const tracks = (axis: 0 | 2): Track[] =>
    [joints.ankle, joints.toe].map((joint) => ({
      contacts: intervals.get(joint)!,
      positions: Float64Array.from(legs, (_, t) => motion.positions[(t * JOINT_COUNT + joint) * 3 + axis]!),
    }));
  const intervals = new Map(
    [joints.ankle, joints.toe].map((joint) => [joint, contactIntervals(motion, joint)]),
  );
  const [along, across] = [tracks(0), tracks(2)];
  const zeroWeights = new Float64Array(legs.length).fill(1);
  let shifts: Vec3[] = [];
  for (let pass = 0; pass < PASSES; pass++) {
    const [x, z] = [leastSquaresShift(along, zeroWeights), leastSquaresShift(across, zeroWeights)];
    shifts = legs.map((_, t) => [x[t]!, 0, z[t]!]);
    legs.forEach((leg, t) => {
      const excess = Math.max(1, Math.hypot(x[t]!, z[t]!) / MAX_SHIFT);
      const ankle = add(leg.thigh, add(leg.shin, shifts[t]!));
      const shortfall = Math.max(0, Math.hypot(...ankle) - maxLegLength(leg));
      zeroWeights[t]! *= excess * excess * (1 + shortfall / SHORTFALL);
    });
  }
  return shifts;
}

/**
 * Foot lock: the motion with feet that do not slide while they are in contact.
 *
 * Each foot is shifted level with the floor and keeps its rotation, so that heel and ball still roll and pivot; thigh and
 * shin follow by two-bone inverse kinematics. Joints above the knees do not move. Bone lengths stay, rotations stay
 * continuous, and positions are again the forward kinematics of the rotations. `fitError` remains that of the fit
 * before. Pure.
 */
export function lockFeet(motion: SolvedMotion): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  for (const joints of LEGS) {
    const { hip, knee, ankle, toe } = joints;
    const frames = Array.from({ length: motion.frames }, (_, frame) => legAt(motion, joints, frame));
    const shifts = shiftsOf(
      motion,
      joints,
      frames.map(({ leg }) => leg),
    );
    frames.forEach(({ leg, thigh, shin, foot }, frame) => {
      const row = frame * JOINT_COUNT;
      const put = (joint: number, parent: Quat, turn: Quat): void => {
        writeQuat(rotations, row + joint, multiply(conjugate(parent), turn));
      };
      const target = add(add(leg.hip, add(leg.thigh, leg.shin)), shifts[frame]!);
      const turns = twoBoneIk(leg, target);
      const [upper, lower] = [multiply(turns.thigh, thigh), multiply(turns.shin, shin)];
      put(hip, readQuat(rotations, row), upper);
      put(knee, upper, lower);
      put(ankle, lower, foot);
      let place = leg.hip;
      for (const [joint, turn] of [
        [knee, upper],
        [ankle, lower],
        [toe, foot],
      ] as const) {
        place = add(place, rotate(turn, readVec(motion.offsets, joint)));
        writeVec(positions, row + joint, place);
      }
    });
  }
  return { ...motion, rotations, positions };
}
