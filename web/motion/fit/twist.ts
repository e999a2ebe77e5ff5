import { betweenInto, rotateInto } from '../math/flat-quaternions';
import {
  addInto,
  anyPerpendicularInto,
  copyInto,
  crossInto,
  dotAt,
  perpendicularInto,
} from '../math/flat-vectors';

/** Weight of the squared change of the twist per frame, where the squared error of a fully bent limb has 1. */
const SMOOTHNESS_WEIGHT = 0.1;
/** Weight of the anatomical prior; it matters only where the limb stays straight for long. */
const PRIOR_WEIGHT = 1e-4;
/** Weight at which an observation moves the running estimate half of the way while the angle is unwrapped. */
const UNWRAP_WEIGHT = 0.02;

function wrap(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

/**
 * Axes perpendicular to a bone that are carried along with it without twist (parallel transport).
 * @param first about where the first one points
 * @returns frames x 3 unit vectors, and those that complete them to right angles with the bone
 */
function carriedAxes(
  bones: Float64Array,
  first: Float64Array,
): { references: Float64Array; sides: Float64Array } {
  const references = new Float64Array(bones.length);
  const sides = new Float64Array(bones.length);
  const turn = new Float64Array(4);
  const any = new Float64Array(3);
  copyInto(references, 0, first, 0);
  for (let t = 0; t < bones.length; t += 3) {
    if (t > 0) {
      betweenInto(turn, 0, bones, t - 3, bones, t);
      rotateInto(references, t, turn, 0, references, t - 3);
    }
    anyPerpendicularInto(any, 0, bones, t);
    perpendicularInto(references, t, references, t, bones, t, any, 0);
    crossInto(sides, t, bones, t, references, t);
  }
  return { references, sides };
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
  const { references, sides } = carriedAxes(bones, priors);
  const weights = new Float64Array(frames);
  const targets = new Float64Array(frames);
  const flat = new Float64Array(3);
  let estimate = 0;
  for (let t = 0; t < frames; t++) {
    const at = 3 * t;
    addInto(flat, 0, hinges, at, bones, at, -dotAt(hinges, at, bones, at));
    const weight = dotAt(flat, 0, flat, 0);
    const angle = Math.atan2(dotAt(flat, 0, sides, at), dotAt(flat, 0, references, at));
    const observed = weight > 0 ? estimate + wrap(angle - estimate) : estimate;
    estimate += ((observed - estimate) * weight) / (weight + UNWRAP_WEIGHT);
    const priorAngle = Math.atan2(dotAt(priors, at, sides, at), dotAt(priors, at, references, at));
    const prior = estimate + wrap(priorAngle - estimate);
    weights[t] = weight + PRIOR_WEIGHT;
    targets[t] = (weight * observed + PRIOR_WEIGHT * prior) / weights[t]!;
  }
  const angles = smooth(targets, weights);
  const axes = new Float64Array(bones.length);
  for (let t = 0; t < frames; t++) {
    addInto(axes, 3 * t, axes, 3 * t, references, 3 * t, Math.cos(angles[t]!));
    addInto(axes, 3 * t, axes, 3 * t, sides, 3 * t, Math.sin(angles[t]!));
  }
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
