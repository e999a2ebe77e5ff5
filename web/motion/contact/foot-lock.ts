import type { SolvedMotion } from '../skeleton/clip';
import { leastSquaresShift, type Track } from './least-squares-shift';
import { type Leg, twoBoneIk, longestLeg } from './two-bone-ik';
import { contactIntervals } from './foot-contacts';
import { conjugate, multiply, type Quat, readQuat, rotate, writeQuat } from '../math/quat';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { add, readVec, sub, type Vec3, writeVec, X_AXIS } from '../math/vec3';

interface Chain {
  readonly hip: number;
  readonly knee: number;
  readonly ankle: number;
  readonly toe: number;
}

const LEGS: readonly Chain[] = [
  { hip: J.left_hip, knee: J.left_knee, ankle: J.left_ankle, toe: J.left_foot },
  { hip: J.right_hip, knee: J.right_knee, ankle: J.right_ankle, toe: J.right_foot },
];

/** Above this shift, metres, a foot is let go little by little. */
const MAX_SHIFT = 0.1;
/** Solutions for the shift; each lets go a little more where the one before asked for too much. */
const PASSES = 6;
/** How far, in metres, a leg may be too short for a shift before the weight of a shift of zero doubles. */
const SHORTFALL = 0.002;

/** The leg of one frame in world axes, and the turns of its bones. */
function legAt(
  motion: SolvedMotion,
  chain: Chain,
  frame: number,
): { leg: Leg; thigh: Quat; shin: Quat; foot: Quat } {
  const at = (joint: number): Vec3 => readVec(motion.positions, frame * JOINT_COUNT + joint);
  const turn = (joint: number): Quat => readQuat(motion.rotations, frame * JOINT_COUNT + joint);
  const thigh = multiply(turn(J.pelvis), turn(chain.hip));
  const shin = multiply(thigh, turn(chain.knee));
  const foot = multiply(shin, turn(chain.ankle));
  const [hip, knee, ankle] = [at(chain.hip), at(chain.knee), at(chain.ankle)];
  // Legs of the rest pose bend about x.
  const leg = { hip, thigh: sub(knee, hip), shin: sub(ankle, knee), hinge: rotate(thigh, X_AXIS) };
  return { leg, thigh, shin, foot };
}

/** The shift over the floor that keeps the foot in place while it is in contact: a level vector a frame, metres. */
function shiftsOf(motion: SolvedMotion, chain: Chain, legs: readonly Leg[]): Vec3[] {
  const tracks = (axis: 0 | 2): Track[] =>
    [chain.ankle, chain.toe].map((joint) => ({
      contacts: intervals.get(joint)!,
      places: Float64Array.from(legs, (_, t) => motion.positions[(t * JOINT_COUNT + joint) * 3 + axis]!),
    }));
  const intervals = new Map(
    [chain.ankle, chain.toe].map((joint) => [joint, contactIntervals(motion, joint)]),
  );
  const [along, across] = [tracks(0), tracks(2)];
  const zeroWeights = new Float64Array(legs.length).fill(1);
  let shifts: Vec3[] = [];
  for (let pass = 0; pass < PASSES; pass++) {
    const [x, z] = [leastSquaresShift(along, zeroWeights), leastSquaresShift(across, zeroWeights)];
    shifts = legs.map((_, t) => [x[t]!, 0, z[t]!]);
    legs.forEach((leg, t) => {
      const far = Math.max(1, Math.hypot(x[t]!, z[t]!) / MAX_SHIFT);
      const ankle = add(leg.thigh, add(leg.shin, shifts[t]!));
      const short = Math.max(0, Math.hypot(...ankle) - longestLeg(leg));
      zeroWeights[t]! *= far * far * (1 + short / SHORTFALL);
    });
  }
  return shifts;
}

/**
 * The motion with feet that rest while they are in contact (foot lock).
 *
 * Feet are shifted level over the floor, whole, with the turn they had, so that heel and ball still roll and pivot;
 * thigh and shin follow by turning at hip, knee and ankle. Nothing above the knees moves. Bone lengths stay, rotations
 * stay continuous, and positions are again what the rotations say. `fitError` remains that of the fit before. Pure.
 */
export function lockFeet(motion: SolvedMotion): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  for (const chain of LEGS) {
    const { hip, knee, ankle, toe } = chain;
    const frames = Array.from({ length: motion.frames }, (_, frame) => legAt(motion, chain, frame));
    const shifts = shiftsOf(
      motion,
      chain,
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
