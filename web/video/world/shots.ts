import type { Observations } from '../observations';
import type { Part } from './series';

/** Most cuts that are named one by one. */
const NAMED = 3;

/**
 * The part between two cuts in which the dancer is seen in most pictures: what is filmed from elsewhere, or at another
 * time, does not go on where the part before it ended.
 * @returns null for a video without cuts
 */
export function longestShot({ times, presence, cuts }: Observations): Part | null {
  if (cuts.length === 0) return null;
  let longest = { start: 0, end: 0, seen: -1 };
  [-Infinity, ...cuts].forEach((from, shot) => {
    const rows = [...times.keys()].filter(
      (row) => times[row]! >= from && times[row]! < (cuts[shot] ?? Infinity),
    );
    const seen = rows.filter((row) => presence[row]! > 0).length;
    if (seen > longest.seen) longest = { start: times[rows[0]!]!, end: times[rows.at(-1)!]!, seen };
  });
  return { start: longest.start, end: longest.end };
}

/**
 * A sentence about the cuts of a video, if there are any.
 * @param used the part of it that is used; null is all
 */
export function adviceOnCuts(cuts: readonly number[], used: Part | null): string[] {
  const inside = cuts.filter((cut) => !used || (cut > used.start && cut <= used.end));
  if (inside.length > 0)
    return [
      `There is ${listOf(inside)} in what is used: what is before and after a cut does not fit together. ` +
        'Choose a part without cuts under “Correct the motion”.',
    ];
  if (cuts.length === 0 || !used) return [];
  return [
    `The video has ${listOf(cuts)}. The longest part without a cut is used, from ${used.start.toFixed(1)} to ` +
      `${used.end.toFixed(1)} s; choose another under “Correct the motion”.`,
  ];
}

/** `a cut at 3.0 s`, `cuts at 3.0, 7.5 s`, `12 cuts, the first at 3.0 s`. */
function listOf(cuts: readonly number[]): string {
  const [first, ...others] = cuts.map((cut) => cut.toFixed(1));
  if (others.length === 0) return `a cut at ${first} s`;
  return others.length < NAMED
    ? `cuts at ${[first, ...others].join(', ')} s`
    : `${cuts.length} cuts, the first at ${first} s`;
}
