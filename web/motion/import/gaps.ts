import { lerp, readVec, type Vec3, writeVec } from '../math/vec3';
import type { Positions } from './positions';

/** Share of missing places from which on a warning says so. */
const MENTIONED = 0.02;

/** A cell of a table for a joint that was not seen. */
const NOT_SEEN = /^(nan|na|n\/a|null|none)?$/i;

/** The number in a cell of a table; not a number where the joint was not seen, null for any other text. */
export function coordinateIn(cell: string): number | null {
  if (NOT_SEEN.test(cell)) return NaN;
  const value = Number(cell);
  return Number.isFinite(value) ? value : null;
}

/**
 * A joint's places over time; where it was not seen, between those before and after. Null where it was never seen.
 * @param isSeen of each place
 */
export function closedGaps(places: readonly Vec3[], isSeen: readonly boolean[]): Vec3[] | null {
  const seen = [...places.keys()].filter((frame) => isSeen[frame]);
  if (seen.length === 0) return null;
  let next = 0;
  return places.map((_, frame) => {
    while (next < seen.length - 1 && seen[next]! < frame) next++;
    const after = seen[next]!;
    const before = after > frame && next > 0 ? seen[next - 1]! : after;
    return lerp(places[before]!, places[after]!, after > before ? (frame - before) / (after - before) : 0);
  });
}

/**
 * Positions in which a place that was not seen (not a number) lies between those before and after. Joints that were never
 * seen are left out.
 */
export function withoutGaps({ joints, places }: Positions): Positions & { readonly warnings: string[] } {
  if (!places.some(Number.isNaN)) return { joints, places, warnings: [] };
  const frames = places.length / (joints.length * 3);
  let missing = 0;
  const tracks = joints.flatMap((joint, index) => {
    const given = Array.from({ length: frames }, (_, frame) =>
      readVec(places, frame * joints.length + index),
    );
    const isSeen = given.map((place) => !place.some(Number.isNaN));
    const track = closedGaps(given, isSeen);
    if (!track) return [];
    missing += isSeen.filter((seen) => !seen).length;
    return [{ joint, index, track }];
  });
  const out = new Float32Array(frames * tracks.length * 3);
  tracks.forEach(({ track }, to) => {
    track.forEach((place, frame) => {
      writeVec(out, frame * tracks.length + to, place);
    });
  });
  const share = missing / (frames * tracks.length);
  const warnings =
    share >= MENTIONED
      ? [
          `${Math.round(100 * share)} % of the places in this file are missing; joints go straight from the last place before to the next one.`,
        ]
      : [];
  // A parent that was never seen is none.
  const parentOf = (parent: number): number => tracks.findIndex(({ index }) => index === parent);
  return {
    joints: tracks.map(({ joint }) => ({ ...joint, parent: parentOf(joint.parent) })),
    places: out,
    warnings,
  };
}
