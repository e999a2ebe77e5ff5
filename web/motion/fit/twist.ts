import { between, rotate } from '../math/quat';
import { cross, dot, perpendicular, scale, type Vec3, add, anyPerpendicular } from '../math/vec3';

/** Squared turn per frame against squared error of a fully bent limb: how much a twist resists to change. */
const STIFFNESS = 0.1;
/** Pull of the anatomical guess; felt only where the limb stays straight for long. */
const GUESS_WEIGHT = 1e-4;
/** Weight at which an observation moves the running estimate half of the way while unwrapping. */
const UNWRAP_WEIGHT = 0.02;

function wrap(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

/**
 * Twist of a limb over time: the hinge axis of its elbow or knee, steady where the limb is straight.
 *
 * A hinge shows only while the limb is bent. The axis is written as an angle against a reference axis that rides along
 * with the bone without twisting (parallel transport, so it has no singular pose), unwrapped, and smoothed over the
 * whole clip by least squares: bent frames pull with the square of the sine of their bend, neighbours hold each other.
 * Straight stretches are thereby interpolated from both sides, without lag and without a pop.
 *
 * All vectors are seen from the body part that the limb hangs on, so that a spin of the dancer is no twist.
 *
 * @param bones unit vectors along the upper bone, one a frame
 * @param hinges observed hinge axes, any length: the length is the trust in them
 * @param guesses hinge axes to fall back to
 * @returns unit vectors perpendicular to the bones
 */
export function steadyHinges(
  bones: readonly Vec3[],
  hinges: readonly Vec3[],
  guesses: readonly Vec3[],
): Vec3[] {
  const frames = bones.length;
  const references: Vec3[] = [];
  const weights = new Float64Array(frames);
  const targets = new Float64Array(frames);
  let estimate = 0;
  for (let t = 0; t < frames; t++) {
    const bone = bones[t]!;
    const carried = t === 0 ? guesses[0]! : rotate(between(bones[t - 1]!, bone), references[t - 1]!);
    const reference = perpendicular(carried, bone, anyPerpendicular(bone));
    references.push(reference);
    const side = cross(bone, reference);
    const angleOf = (axis: Vec3): number => Math.atan2(dot(axis, side), dot(axis, reference));

    const hinge = hinges[t]!;
    const flat = add(hinge, scale(bone, -dot(hinge, bone)));
    const weight = dot(flat, flat);
    const observed = weight > 0 ? estimate + wrap(angleOf(flat) - estimate) : estimate;
    estimate += ((observed - estimate) * weight) / (weight + UNWRAP_WEIGHT);
    const guess = estimate + wrap(angleOf(guesses[t]!) - estimate);
    weights[t] = weight + GUESS_WEIGHT;
    targets[t] = (weight * observed + GUESS_WEIGHT * guess) / weights[t]!;
  }
  const angles = smooth(targets, weights);
  return references.map((reference, t) => {
    const side = cross(bones[t]!, reference);
    return add(scale(reference, Math.cos(angles[t]!)), scale(side, Math.sin(angles[t]!)));
  });
}

/** Minimises sum w (x - target)^2 + STIFFNESS sum (x_t - x_(t-1))^2: one tridiagonal system, solved in place. */
function smooth(targets: Float64Array, weights: Float64Array): Float64Array {
  const frames = targets.length;
  const above = new Float64Array(frames);
  const x = new Float64Array(frames);
  for (let t = 0; t < frames; t++) {
    const neighbours = (t > 0 ? 1 : 0) + (t < frames - 1 ? 1 : 0);
    const pivot = weights[t]! + STIFFNESS * neighbours + (t > 0 ? STIFFNESS * above[t - 1]! : 0);
    above[t] = t < frames - 1 ? -STIFFNESS / pivot : 0;
    x[t] = (weights[t]! * targets[t]! + (t > 0 ? STIFFNESS * x[t - 1]! : 0)) / pivot;
  }
  for (let t = frames - 2; t >= 0; t--) x[t] = x[t]! - above[t]! * x[t + 1]!;
  return x;
}
