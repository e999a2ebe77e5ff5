import { between, rotate } from '../math/quat';
import {
  add,
  anyPerpendicular,
  cross,
  dot,
  perpendicular,
  readVec,
  scale,
  type Vec3,
  writeVec,
} from '../math/vec3';

/** Weight of the squared change of the twist per frame, where the squared error of a fully bent limb has 1. */
const SMOOTHNESS_WEIGHT = 1;
/** Weight of the anatomical prior; it matters only where the limb stays straight for long. */
const PRIOR_WEIGHT = 1e-4;
/** Weight at which an observation moves the running estimate half of the way while the angle is unwrapped. */
const UNWRAP_WEIGHT = 0.02;

function wrap(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

/**
 * Twist of a limb over time: the hinge axis of its elbow or knee, interpolated where the limb is straight.
 *
 * A hinge shows only while the limb is bent. The axis is written as an angle to a reference axis that is carried along
 * with the bone without twist (parallel transport, which has no singular pose), unwrapped, and smoothed over the whole
 * clip by weighted least squares: a frame weighs the squared sine of its bend, and changes between frames are penalised.
 * Straight stretches are thereby interpolated from both sides, without lag and without a jump.
 *
 * All vectors are in the axes of the body part that carries the limb, so that a spin of the dancer is no twist.
 *
 * @param bones frames x 3, unit vectors along the upper bone
 * @param hinges frames x 3, observed hinge axes; the squared length is their weight
 * @param priors frames x 3, hinge axes of the anatomical prior
 * @returns frames x 3, unit vectors perpendicular to the bones
 */
export function smoothHinges(bones: Float64Array, hinges: Float64Array, priors: Float64Array): Float64Array {
  const frames = bones.length / 3;
  const references = new Float64Array(bones.length);
  const weights = new Float64Array(frames);
  const targets = new Float64Array(frames);
  let estimate = 0;
  for (let t = 0; t < frames; t++) {
    const bone = readVec(bones, t);
    const prior = readVec(priors, t);
    const carried =
      t === 0 ? prior : rotate(between(readVec(bones, t - 1), bone), readVec(references, t - 1));
    const reference = perpendicular(carried, bone, anyPerpendicular(bone));
    writeVec(references, t, reference);
    const side = cross(bone, reference);
    const angleOf = (axis: Vec3): number => Math.atan2(dot(axis, side), dot(axis, reference));

    const hinge = readVec(hinges, t);
    const flat = add(hinge, scale(bone, -dot(hinge, bone)));
    const weight = dot(flat, flat);
    const observed = weight > 0 ? estimate + wrap(angleOf(flat) - estimate) : estimate;
    estimate += ((observed - estimate) * weight) / (weight + UNWRAP_WEIGHT);
    const expected = estimate + wrap(angleOf(prior) - estimate);
    weights[t] = weight + PRIOR_WEIGHT;
    targets[t] = (weight * observed + PRIOR_WEIGHT * expected) / weights[t]!;
  }
  const angles = smooth(targets, weights);
  const axes = new Float64Array(bones.length);
  angles.forEach((angle, t) => {
    const reference = readVec(references, t);
    const side = cross(readVec(bones, t), reference);
    writeVec(axes, t, add(scale(reference, Math.cos(angle)), scale(side, Math.sin(angle))));
  });
  return axes;
}

/** Minimises sum w (x - target)^2 + SMOOTHNESS_WEIGHT sum (x_t - x_(t-1))^2: one tridiagonal system, solved in place. */
function smooth(targets: Float64Array, weights: Float64Array): Float64Array {
  const frames = targets.length;
  const above = new Float64Array(frames);
  const x = new Float64Array(frames);
  for (let t = 0; t < frames; t++) {
    const neighbours = (t > 0 ? 1 : 0) + (t < frames - 1 ? 1 : 0);
    const pivot =
      weights[t]! + SMOOTHNESS_WEIGHT * neighbours + (t > 0 ? SMOOTHNESS_WEIGHT * above[t - 1]! : 0);
    above[t] = t < frames - 1 ? -SMOOTHNESS_WEIGHT / pivot : 0;
    x[t] = (weights[t]! * targets[t]! + (t > 0 ? SMOOTHNESS_WEIGHT * x[t - 1]! : 0)) / pivot;
  }
  for (let t = frames - 2; t >= 0; t--) x[t] = x[t]! - above[t]! * x[t + 1]!;
  return x;
}
