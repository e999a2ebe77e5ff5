import { aboutAxis, between, conjugate, multiply, type Quat, rotate } from '../../math/quat';
import { add, direction, distance, dot, length, sub, type Vec3, X_AXIS, Y_AXIS } from '../../math/vec3';

/** A leg in the world before its feet are placed. */
export interface Leg {
  /** Place of the hip, and rotation of what it hangs on. */
  readonly hip: Vec3;
  readonly above: Quat;
  /** Own rotations of hip and ankle. */
  readonly hipTurn: Quat;
  readonly ankleTurn: Quat;
  /** Offsets from hip to knee, knee to ankle, ankle to toe. */
  readonly thigh: Vec3;
  readonly shin: Vec3;
  readonly foot: Vec3;
  /** Where ankle and toe are to be. */
  readonly ankleAt: Vec3;
  readonly toeAt: Vec3;
}

/** Local rotations of hip, knee and ankle. */
type LegTurns = readonly [Quat, Quat, Quat];

/** A leg is never quite straight, so that its knee has a side to bend to. */
const REACH = 0.9999;

/** Rotation by which one vector gets the direction of another. */
const swing = (from: Vec3, to: Vec3): Quat => between(direction(from, Y_AXIS), direction(to, Y_AXIS));

/**
 * Places ankle and toe: the knee bends about its own x axis, as MMD limits it, by the law of cosines; the leg then swings
 * to the ankle's place by the shortest way, and the foot to the toe's.
 */
export function solveLeg(leg: Leg): LegTurns {
  const { hip, above, thigh, shin, foot, ankleAt, toeAt } = leg;
  const [a, b] = [length(thigh), length(shin)];
  const wanted = Math.min(REACH * (a + b), Math.max(Math.abs(a - b) + 1e-3, distance(hip, ankleAt)));
  const rest = Math.atan2(thigh[1] * shin[2] - thigh[2] * shin[1], dot(thigh, shin));
  const cosine = (wanted * wanted - a * a - b * b) / (2 * a * b);
  const knee = aboutAxis(X_AXIS, Math.acos(Math.min(1, Math.max(-1, cosine))) - rest);
  const start = multiply(above, leg.hipTurn);
  const reach = rotate(start, add(thigh, rotate(knee, shin)));
  const world = multiply(swing(reach, sub(ankleAt, hip)), start);
  const kneeWorld = multiply(world, knee);
  const ankle = add(hip, rotate(world, add(thigh, rotate(knee, shin))));
  const footStart = multiply(kneeWorld, leg.ankleTurn);
  const footWorld = multiply(swing(rotate(footStart, foot), sub(toeAt, ankle)), footStart);
  return [multiply(conjugate(above), world), knee, multiply(conjugate(kneeWorld), footWorld)];
}
