/** How much dances of the same length differ in their poses, wherever the dancers stand. Positions are T x 22 x 3, metres. */
import { J, JOINT_COUNT } from './skeleton';

const WIDTH = JOINT_COUNT * 3;

/** Mean distance of the joints in one frame, both pelvises in the same place, metres. */
export function poseDistance(a: Float32Array, b: Float32Array, frame: number): number {
  const first = frame * WIDTH;
  const root = first + J.pelvis * 3;
  const [dx, dy, dz] = [a[root]! - b[root]!, a[root + 1]! - b[root + 1]!, a[root + 2]! - b[root + 2]!];
  let sum = 0;
  for (let i = first; i < first + WIDTH; i += 3) {
    const [x, y, z] = [a[i]! - b[i]! - dx, a[i + 1]! - b[i + 1]! - dy, a[i + 2]! - b[i + 2]! - dz];
    sum += Math.sqrt(x * x + y * y + z * z);
  }
  return sum / JOINT_COUNT;
}

/** The mean of `poseDistance` over all frames. */
export function danceDistance(a: Float32Array, b: Float32Array): number {
  const frames = a.length / WIDTH;
  let sum = 0;
  for (let frame = 0; frame < frames; frame++) sum += poseDistance(a, b, frame);
  return sum / frames;
}

/**
 * The dances of which even the two that are nearest to each other are as far apart as possible; the earliest such ones
 * where several are.
 * @param count at most the number of dances
 * @returns their indices, ascending
 */
export function mostDifferent(dances: readonly Float32Array[], count: number): number[] {
  const distances = dances.map((a, i) => dances.map((b, k) => (k < i ? danceDistance(a, b) : 0)));
  let best: { readonly chosen: number[]; readonly nearest: number } = { chosen: [], nearest: -Infinity };
  const choose = (chosen: number[], nearest: number): void => {
    if (nearest <= best.nearest) return;
    if (chosen.length === count) {
      best = { chosen, nearest };
      return;
    }
    for (let next = (chosen.at(-1) ?? -1) + 1; next < dances.length; next++)
      choose([...chosen, next], Math.min(nearest, ...chosen.map((one) => distances[next]![one]!)));
  };
  choose([], Infinity);
  return best.chosen;
}

/** The frame in which even the two dances that are most alike are as far apart as possible. */
export function mostDifferentFrame(dances: readonly Float32Array[]): number {
  const pairs = dances.flatMap((a, i) => dances.slice(i + 1).map((b) => [a, b] as const));
  const frames = (dances[0]?.length ?? 0) / WIDTH;
  let [best, most] = [0, -Infinity];
  for (let frame = 0; frame < frames; frame++) {
    const nearest = Math.min(...pairs.map(([a, b]) => poseDistance(a, b, frame)));
    if (nearest > most) [best, most] = [frame, nearest];
  }
  return best;
}
