import {
  conjugate,
  multiply,
  negate,
  normaliseQuat,
  type Quat,
  quatDot,
  readQuat,
  slerp,
  writeQuat,
} from '../math/quat';
import { bodyFrame } from '../math/rigid';
import { rowDistance } from '../math/rows';
import { lerp, readVec, sub, type Vec3 } from '../math/vec3';
import { J, JOINT_COUNT } from '../skeleton/skeleton';

/** World rotations of the trunk's two rigid parts, frames x 4. */
export interface TrunkRotations {
  readonly pelvis: Float64Array;
  readonly chest: Float64Array;
}

/** A rotation of each part to start a fit from. */
export interface SteadyTrunk extends TrunkRotations {
  /** How far the joints show a part's rotation themselves, 0 to 1, one number a frame. */
  readonly certainty: Readonly<Record<keyof TrunkRotations, Float64Array>>;
}

/** The joints at both sides of a part, which show where it faces. */
const SIDES = {
  pelvis: [J.left_hip, J.right_hip],
  chest: [J.left_collar, J.right_collar],
} as const;

/** How fast the sides show less of the rotation, the nearer they are to each other than at rest. */
const CERTAINTY_POWER = 6;
/** Standard deviation in time of the Gaussian filter over uncertain rotations, seconds, and how often it is applied. */
const SMOOTHING = 0.1;
const PASSES = 3;

/**
 * Rotations of the trunk as the joints show them: of the pelvis with x from hip to hip and y from the hips to the spine,
 * of the chest with x from collar to collar and y from the upper spine to the neck.
 *
 * @param observed frames x 22 x 3, metres
 */
export function trunkRotations(observed: Float64Array): TrunkRotations {
  const frames = observed.length / (3 * JOINT_COUNT);
  const pelvis = new Float64Array(4 * frames);
  const chest = new Float64Array(4 * frames);
  for (let frame = 0; frame < frames; frame++) {
    const at = (joint: number): Vec3 => readVec(observed, frame * JOINT_COUNT + joint);
    const [left, right] = [at(J.left_hip), at(J.right_hip)];
    writeQuat(pelvis, frame, bodyFrame(sub(left, right), sub(at(J.spine1), lerp(left, right, 0.5))));
    const across = sub(at(J.left_collar), at(J.right_collar));
    writeQuat(chest, frame, bodyFrame(across, sub(at(J.neck), at(J.spine3))));
  }
  return { pelvis, chest };
}

/**
 * The rotations, but the nearer the sides of a part are to each other, the more it turns as in the frames around it.
 *
 * Where a decoder is unsure which way a dancer faces, both hips or both collars are in one place, and when they part
 * again on the other side the trunk would flip within a frame. Here it turns there instead, both parts the same way.
 *
 * @param observed frames x 22 x 3, metres
 * @param offsets of the rest skeleton, 22 x 3 metres
 */
export function steadyTrunk(
  trunk: TrunkRotations,
  observed: Float64Array,
  offsets: Float32Array,
  fps: number,
): SteadyTrunk {
  const certainty = {
    pelvis: certaintyOf('pelvis', observed, offsets),
    chest: certaintyOf('chest', observed, offsets),
  };
  const deviation = SMOOTHING * fps;
  const surest = certainty.pelvis.map((pelvis, t) => Math.max(pelvis, certainty.chest[t]!));
  const middle = rowsOf(trunk.pelvis, (t) => {
    const [pelvis, chest] = [certainty.pelvis[t]!, certainty.chest[t]!];
    return slerp(readQuat(trunk.pelvis, t), readQuat(trunk.chest, t), chest / (pelvis + chest || 1));
  });
  const whole = steady(withoutSignChanges(middle), surest, deviation);
  return {
    pelvis: steadyAgainst(whole, trunk.pelvis, certainty.pelvis, deviation),
    chest: steadyAgainst(whole, trunk.chest, certainty.chest, deviation),
    certainty,
  };
}

/**
 * The rotations of a part, steadied as it turns against the whole trunk, by less than half a turn: where it is uncertain
 * which way round it turned, it turns with the other part, and the spine is not wound up.
 * @param whole rotations of the trunk: those of the part whose sides are farther apart
 */
function steadyAgainst(
  whole: Float64Array,
  part: Float64Array,
  certainty: Float64Array,
  deviation: number,
): Float64Array {
  const relative = rowsOf(part, (t) => {
    const turn = multiply(conjugate(readQuat(whole, t)), readQuat(part, t));
    return turn[3] < 0 ? negate(turn) : turn;
  });
  const turned = steady(relative, certainty, deviation);
  return rowsOf(part, (t) => multiply(readQuat(whole, t), readQuat(turned, t)));
}

/** One rotation for each of those given. */
function rowsOf(rotations: Float64Array, rotation: (frame: number) => Quat): Float64Array {
  const rows = new Float64Array(rotations.length);
  for (let t = 0; t < rows.length / 4; t++) writeQuat(rows, t, rotation(t));
  return rows;
}

function certaintyOf(
  part: keyof TrunkRotations,
  observed: Float64Array,
  offsets: Float32Array,
): Float64Array {
  const [left, right] = SIDES[part];
  const atRest = rowDistance(offsets, left, offsets, right);
  return Float64Array.from({ length: observed.length / (3 * JOINT_COUNT) }, (_, frame) => {
    const row = frame * JOINT_COUNT;
    const distance = rowDistance(observed, row + left, observed, row + right);
    return Math.min(1, distance / atRest) ** CERTAINTY_POWER;
  });
}

/** @param deviation of the Gaussian filter, frames */
function steady(rotations: Float64Array, certainty: Float64Array, deviation: number): Float64Array {
  const uncertain = [...certainty.keys()].filter((t) => certainty[t]! < 1);
  if (uncertain.length === 0) return rotations;
  const weights = gaussianWeights(deviation);
  let turned = rotations;
  for (let pass = 0; pass < PASSES; pass++) {
    const next = turned.slice();
    for (const t of uncertain) {
      const around = normaliseQuat(weightedSum(turned, t, weights));
      writeQuat(next, t, slerp(around, readQuat(rotations, t), certainty[t]!));
    }
    turned = next;
  }
  return turned;
}

/** The same rotations, of signs that make neighbours alike. */
function withoutSignChanges(rotations: Float64Array): Float64Array {
  const alike = rotations.slice();
  for (let t = 1; t < alike.length / 4; t++) {
    const own = readQuat(alike, t);
    if (quatDot(readQuat(alike, t - 1), own) < 0) writeQuat(alike, t, negate(own));
  }
  return alike;
}

/**
 * Sum of the quaternions around a frame, weighted by their distance in time; the ends are repeated. Not `gaussianFilter`
 * of a whole clip, since few frames are uncertain.
 */
function weightedSum(rotations: Float64Array, t: number, weights: readonly number[]): Quat {
  const last = rotations.length / 4 - 1;
  const sum: [number, number, number, number] = [0, 0, 0, 0];
  for (let lag = 1 - weights.length; lag < weights.length; lag++) {
    const at = 4 * Math.min(last, Math.max(0, t + lag));
    const weight = weights[Math.abs(lag)]!;
    for (let axis = 0; axis < 4; axis++) sum[axis]! += weight * rotations[at + axis]!;
  }
  return sum;
}

/** Weights of a Gaussian filter by distance, cut off at three deviations; the sum does not matter. */
function gaussianWeights(deviation: number): number[] {
  const radius = Math.ceil(3 * deviation);
  return Array.from({ length: radius + 1 }, (_, lag) => Math.exp(-0.5 * (lag / deviation) ** 2));
}
