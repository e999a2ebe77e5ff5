import { FEET, JOINT_COUNT, J } from '../../motion/skeleton/skeleton';
import {
  add,
  cross,
  direction,
  dot,
  lerp,
  readVec,
  scale,
  sub,
  type Vec3,
  writeVec,
  X_AXIS,
  Y_AXIS,
  ZERO,
} from '../../motion/math/vec3';
import { percentile } from '../../motion/math/statistics';

/** How slow a toe is that stands on the floor, m/s. */
const STANDING_SPEED = 0.35;
/** Weight of the body's own upright against the floor: metres of spread over the floor at which both count the same. */
const BODY_SPREAD = 0.5;

/**
 * Turns a motion upright and puts its floor at y = 0. Which way is up is told by the body, which is upright on average,
 * and by the toes, which stand in one plane at moments of little speed; the farther they spread, the more the plane
 * counts.
 * @param joints frames x 22 x 3, metres, roughly y up
 * @returns the same joints upright
 */
export function levelled(joints: Float32Array, fps: number): { joints: Float32Array; up: Vec3 } {
  const frames = joints.length / (3 * JOINT_COUNT);
  let sum: Vec3 = ZERO;
  for (let frame = 0; frame < frames; frame++) {
    const at = (joint: number): Vec3 => readVec(joints, frame * JOINT_COUNT + joint);
    const feet = lerp(at(J.left_ankle), at(J.right_ankle), 0.5);
    sum = add(sum, direction(sub(at(J.neck), feet), Y_AXIS));
  }
  const body = direction(sum, Y_AXIS);
  const up = planeNormal(standingToes(joints, frames, fps), body);
  return { joints: onFloor(turned(joints, up)), up };
}

function standingToes(joints: Float32Array, frames: number, fps: number): Vec3[] {
  const points: Vec3[] = [];
  for (const joint of [J.left_foot, J.right_foot]) {
    for (let frame = 1; frame < frames; frame++) {
      const now = readVec(joints, frame * JOINT_COUNT + joint);
      const before = readVec(joints, (frame - 1) * JOINT_COUNT + joint);
      const step = sub(now, before);
      if (Math.sqrt(dot(step, step)) * fps < STANDING_SPEED) points.push(now);
    }
  }
  return points;
}

/**
 * Normal of the plane through points, by least squares, drawn towards `guess` where they spread little: with axes a and
 * b square to the guess, heights h = c + p a + q b are fitted with a ridge on p and q.
 */
function planeNormal(points: readonly Vec3[], guess: Vec3): Vec3 {
  if (points.length < 3) return guess;
  const a = direction(sub(X_AXIS, scale(guess, dot(X_AXIS, guess))), X_AXIS);
  const b = cross(a, guess);
  const mean = scale(points.reduce(add, ZERO), 1 / points.length);
  const ridge = points.length * BODY_SPREAD * BODY_SPREAD;
  let [aa, ab, bb, ah, bh] = [ridge, 0, ridge, 0, 0];
  for (const point of points) {
    const d = sub(point, mean);
    const [x, y, h] = [dot(d, a), dot(d, b), dot(d, guess)];
    aa += x * x;
    ab += x * y;
    bb += y * y;
    ah += x * h;
    bh += y * h;
  }
  const determinant = aa * bb - ab * ab;
  const [p, q] = [(ah * bb - bh * ab) / determinant, (bh * aa - ah * ab) / determinant];
  return direction(sub(guess, add(scale(a, p), scale(b, q))), guess);
}

/** The joints turned so that `up` becomes y, without a turn about y. */
function turned(joints: Float32Array, up: Vec3): Float32Array {
  const x = direction(sub(X_AXIS, scale(up, dot(X_AXIS, up))), X_AXIS);
  const z = cross(x, up);
  const out = new Float32Array(joints.length);
  for (let i = 0; i < joints.length / 3; i++) {
    const v = readVec(joints, i);
    writeVec(out, i, [dot(v, x), dot(v, up), dot(v, z)]);
  }
  return out;
}

/** The joints with their toes on the floor most of the time. */
function onFloor(joints: Float32Array): Float32Array {
  const frames = joints.length / (3 * JOINT_COUNT);
  const lowest = Float64Array.from({ length: frames }, (_, frame) =>
    Math.min(...FEET.map((joint) => joints[(frame * JOINT_COUNT + joint) * 3 + 1]!)),
  );
  const floor = percentile(lowest, 30);
  return joints.map((value, i) => (i % 3 === 1 ? value - floor : value));
}
