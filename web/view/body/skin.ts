import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import { shapesNear, type Part } from './part';
import { neighbourMeans, type Net } from './surface-nets';

/** Skin weights of a mesh. */
export interface Skin {
  /** vertices x 4, joints. */
  readonly skinJoints: Uint8Array;
  /** vertices x 4, their shares; they sum to 1. */
  readonly skinWeights: Float32Array;
}

/** Length over which the weight of a part falls off with its distance beyond the nearest part, metres. */
const FALLOFF = 0.014;
/** Rounds of smoothing the weights over the surface. */
const SMOOTHING = 3;

/**
 * Four joints and shares per vertex: those of the nearest parts, smoothed over the surface.
 *
 * @param cell spacing of the mesh, metres.
 */
export function skinTo(net: Net, parts: readonly Part[], cell: number): Skin {
  const count = net.positions.length / 3;
  let shares = new Float32Array(count * JOINT_COUNT);
  for (let v = 0; v < count; v++) {
    const [x, y, z] = [net.positions[v * 3]!, net.positions[v * 3 + 1]!, net.positions[v * 3 + 2]!];
    const local = shapesNear(parts, x, y, z, cell);
    const distances = local.map((part) => part.field(x, y, z));
    const least = Math.min(...distances);
    let total = 0;
    local.forEach((part, i) => {
      const weight = Math.exp(-(distances[i]! - least) / FALLOFF);
      if (weight < 0.01) return;
      total += weight;
      for (const [joint, share] of part.weights(x, y, z)) shares[v * JOINT_COUNT + joint]! += weight * share;
    });
    for (let j = 0; j < JOINT_COUNT; j++) shares[v * JOINT_COUNT + j]! /= total;
  }
  for (let pass = 0; pass < SMOOTHING; pass++) {
    const means = neighbourMeans(net.quads, shares, JOINT_COUNT);
    shares = shares.map((share, i) => 0.5 * share + 0.5 * means[i]!);
  }
  return strongest(shares, count);
}

/** Keeps the four largest shares of each vertex and makes them sum to 1. */
function strongest(shares: Float32Array, count: number): Skin {
  const skinJoints = new Uint8Array(count * 4);
  const skinWeights = new Float32Array(count * 4);
  for (let v = 0; v < count; v++) {
    const row = shares.subarray(v * JOINT_COUNT, (v + 1) * JOINT_COUNT);
    let total = 0;
    for (let slot = 0; slot < 4; slot++) {
      let best = 0;
      for (let j = 1; j < JOINT_COUNT; j++) if (row[j]! > row[best]!) best = j;
      skinJoints[v * 4 + slot] = best;
      skinWeights[v * 4 + slot] = row[best]!;
      total += row[best]!;
      row[best] = 0;
    }
    for (let slot = 0; slot < 4; slot++) skinWeights[v * 4 + slot]! /= total;
  }
  return { skinJoints, skinWeights };
}
