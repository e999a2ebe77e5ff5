import type { MotionClip } from '../skeleton/clip';
import { forwardOf } from '../skeleton/heading';
import { ARMS, LEGS, type LimbJoints } from '../skeleton/limbs';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { rotate } from '../math/quat';
import {
  add,
  cross,
  direction,
  distance,
  dot,
  length,
  lerp,
  perpendicular,
  readVec,
  scale,
  smoothstep,
  sub,
  type Vec3,
  writeVec,
  X_AXIS,
} from '../math/vec3';
import { gaussianFilter } from '../math/statistics';
import { maxLimbLength, twoBoneIk } from './two-bone-ik';

/** Distance of two wrists up to which they count as joined, and from which they do not, metres. */
const JOINED = 0.15;
const APART = 0.45;
/** Standard deviation of the filter over how far a hand is joined, seconds: hands meet and part within two frames. */
const JOIN_SMOOTHING = 0.2;
/** Distance of a wrist from the shoulder, as a share of the arm's length, up to which it moves with the body, and from which it may stay. */
const FOLDED = 0.25;
const OPEN = 0.8;
/** By how much an arm is too short for its joined hand up to which it reaches for it, and from which it does not, metres. */
const WITHIN_REACH = 0.15;
const OUT_OF_REACH = 0.45;
/** Weight of the side to which a limb bends, where a right angle has 1: it decides only where the limb is straight. */
const BEND_WEIGHT = 0.05;

/**
 * The same dance by a body of another size. The pelvis stays above its place on the floor and rises with the body; feet
 * stay where they stand and hands that are joined with the partner's stay joined, by two-bone inverse kinematics, as far
 * as the limbs reach; hands that are far out of reach are let go. All other bones keep their direction. Pure.
 *
 * @param clip of a body with constant bone lengths, on a floor at height 0
 * @param factor new size / size, above 0
 * @param partner the other dancer, who stays as they are; as many frames
 * @param toeRest height of the toes of a standing dancer of any size, metres
 */
export function resized(clip: MotionClip, factor: number, partner: MotionClip, toeRest: number): MotionClip {
  if (factor === 1) return clip;
  const positions = clip.positions.slice();
  const joined = ARMS.map(({ end }) => joinedShares(clip, partner, end));
  for (let frame = 0; frame < clip.frames; frame++) {
    const row = frame * JOINT_COUNT;
    const raised = (y: number): number => toeRest + factor * (y - toeRest);
    const before = (joint: number): Vec3 => readVec(clip.positions, row + joint);
    const root = before(J.pelvis);
    const grown = (joint: number): Vec3 => {
      const [x, y, z] = before(joint);
      return [root[0] + factor * (x - root[0]), raised(y), root[2] + factor * (z - root[2])];
    };
    const put = (joint: number, at: Vec3): void => writeVec(positions, row + joint, at);
    for (let joint = 0; joint < JOINT_COUNT; joint++) put(joint, grown(joint));

    const forward = forwardOf(sub(before(J.left_hip), before(J.right_hip)));
    for (const leg of LEGS) {
      const [ankle, toe] = [before(leg.end), before(leg.toe)];
      // The middle of the foot stays, so that it may turn on its heel as well as on its ball.
      const [midX, midZ] = [(ankle[0] + toe[0]) / 2, (ankle[2] + toe[2]) / 2];
      const wanted: Vec3 = [
        midX + factor * (ankle[0] - midX),
        raised(ankle[1]),
        midZ + factor * (ankle[2] - midZ),
      ];
      const moved = reach(leg, -1, grown, wanted, forward);
      put(leg.middle, moved.middle);
      put(leg.end, moved.end);
      put(leg.toe, add(moved.end, scale(sub(toe, ankle), factor)));
    }
    ARMS.forEach((arm, side) => {
      // A folded arm would swing round its shoulder.
      const share = joined[side]![frame]! * opened(arm, before) * reachable(arm, grown, before(arm.end));
      if (share === 0) return;
      const moved = reach(arm, 1, grown, lerp(grown(arm.end), before(arm.end), share), forward);
      put(arm.middle, moved.middle);
      put(arm.end, moved.end);
    });
  }
  return { ...clip, positions };
}

/** How far a wrist is joined with one of the partner's in every frame, 0 to 1. */
function joinedShares(clip: MotionClip, partner: MotionClip, wrist: number): Float64Array {
  const shares = Float64Array.from({ length: clip.frames }, (_, frame) => {
    const row = frame * JOINT_COUNT;
    const at = readVec(clip.positions, row + wrist);
    const gaps = ARMS.map(({ end }) => distance(at, readVec(partner.positions, row + end)));
    return 1 - smoothstep(JOINED, APART, Math.min(...gaps));
  });
  return gaussianFilter(shares, JOIN_SMOOTHING * clip.fps);
}

/** How far an arm is open, 0 to 1. */
function opened({ start, middle, end }: LimbJoints, at: (joint: number) => Vec3): number {
  const whole = distance(at(start), at(middle)) + distance(at(middle), at(end));
  return smoothstep(FOLDED, OPEN, distance(at(start), at(end)) / whole);
}

/**
 * How far an arm is long enough for a place of its hand, 0 to 1: beside a much taller partner it would point into the air,
 * and swing down and up again within three frames where it folds.
 */
function reachable({ start, middle, end }: LimbJoints, at: (joint: number) => Vec3, hand: Vec3): number {
  const whole = distance(at(start), at(middle)) + distance(at(middle), at(end));
  return 1 - smoothstep(WITHIN_REACH, OUT_OF_REACH, distance(at(start), hand) - whole);
}

/**
 * Middle and end of a limb whose end is brought to `wanted`, or as far on the way there as the limb reaches.
 * @param bends 1 where the lower bone bends forwards, as an arm's, and -1 where backwards
 */
function reach(
  { start, middle, end }: LimbJoints,
  bends: 1 | -1,
  at: (joint: number) => Vec3,
  wanted: Vec3,
  forward: Vec3,
): { readonly middle: Vec3; readonly end: Vec3 } {
  const from = at(start);
  const upper = sub(at(middle), from);
  const lower = sub(at(end), at(middle));
  const along = direction(upper, X_AXIS);
  const bend = cross(upper, lower);
  const straight = scale(cross(along, forward), bends * BEND_WEIGHT * length(upper) * length(lower));
  const hinge = perpendicular(add(bend, straight), along, X_AXIS);
  const target = within(from, at(end), wanted, maxLimbLength(upper, lower));
  const turns = twoBoneIk({ start: from, upper, lower, hinge }, target);
  const knee = add(from, rotate(turns.upper, upper));
  return { middle: knee, end: add(knee, rotate(turns.lower, lower)) };
}

/** The point nearest to `to` on the way from `from`, which lies within the radius around `centre`, that does so too. */
function within(centre: Vec3, from: Vec3, to: Vec3, radius: number): Vec3 {
  const [start, way] = [sub(from, centre), sub(to, from)];
  // |start + s way|^2 = radius^2, the larger root.
  const a = dot(way, way);
  if (a === 0) return to;
  const b = dot(start, way) / a;
  const c = (dot(start, start) - radius * radius) / a;
  const s = Math.sqrt(Math.max(0, b * b - c)) - b;
  return add(from, scale(way, Math.min(1, Math.max(0, s))));
}
