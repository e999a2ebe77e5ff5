import { aboutAxis, between, multiply, type Quat, rotate } from '../math/quat';
import { add, cross, direction, dot, length, sub, type Vec3 } from '../math/vec3';

/** A leg longer than this share of its bones has no bend left: a millimetre would turn the knee by centimetres. */
const STRAIGHT = 0.985;

/** A leg as two bones, in world axes. */
export interface Leg {
  readonly hip: Vec3;
  /** Vectors hip to knee and knee to ankle, metres. */
  readonly thigh: Vec3;
  readonly shin: Vec3;
  /** Unit axis through the knee, perpendicular to the thigh, about which the shin bends backwards. */
  readonly hinge: Vec3;
}

/**
 * Two-bone inverse kinematics, analytic by the law of cosines: the turns that bring the ankle to `target` with hip and
 * bone lengths kept. `thigh` and `shin` are to be applied in world axes to the bones as they are.
 *
 * First the knee bends about its own hinge until the leg is as long as the way to the target, then the whole leg
 * swings there the shortest way: the knee goes on looking where it looked. An ankle that stays where it is leaves the
 * leg as it is. Where the target is too far, the leg stretches towards it and stops short.
 */
export function twoBoneIk(leg: Leg, target: Vec3): { thigh: Quat; shin: Quat } {
  const { hip, thigh, shin, hinge } = leg;
  const wanted = sub(target, hip);
  // |thigh + turned shin|^2 = |thigh|^2 + |shin|^2 + 2 (c cos + s sin) of the turn, largest where the knee is straight.
  const along = dot(hinge, shin);
  const c = dot(thigh, shin) - along * dot(hinge, thigh);
  const s = dot(thigh, cross(hinge, shin));
  const product = (dot(wanted, wanted) - dot(thigh, thigh) - dot(shin, shin)) / 2;
  const bent = Math.acos(Math.max(-1, Math.min(1, product / Math.hypot(c, s))));
  // As much more as the target asks for: a knee that is bent the wrong way by noise comes through the straight leg
  // without a jump.
  const bend = aboutAxis(hinge, bent - Math.abs(Math.atan2(s, c)));
  const reached = add(thigh, rotate(bend, shin));
  const swing = between(direction(reached, wanted), direction(wanted, reached));
  return { thigh: swing, shin: multiply(swing, bend) };
}

/** The largest length of the leg, hip to ankle in metres, that is asked for: nearly straight, or as it was anyway. */
export function longestLeg({ thigh, shin }: Leg): number {
  return Math.max(length(add(thigh, shin)), STRAIGHT * (length(thigh) + length(shin)));
}
