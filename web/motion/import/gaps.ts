import type { Positions } from './positions';

/** Share of missing places from which on a warning says so. */
const MENTIONED = 0.02;

/**
 * Positions in which a place that was not seen (not a number) lies between those before and after. Joints that were never
 * seen are left out.
 */
export function withoutGaps({ joints, places }: Positions): Positions & { readonly warnings: string[] } {
  const width = joints.length * 3;
  const frames = places.length / width;
  const isSeen = (frame: number, joint: number): boolean =>
    [0, 1, 2].every((axis) => !Number.isNaN(places[frame * width + joint * 3 + axis]));
  const all = Array.from({ length: frames }, (_, frame) => frame);
  const seen = joints.map((_, joint) => all.filter((frame) => isSeen(frame, joint)));
  const kept = [...joints.keys()].filter((joint) => seen[joint]!.length > 0);
  const out = new Float32Array(frames * kept.length * 3);
  let missing = 0;
  kept.forEach((joint, to) => {
    const known = seen[joint]!;
    missing += frames - known.length;
    let next = 0;
    for (let frame = 0; frame < frames; frame++) {
      while (next < known.length - 1 && known[next]! < frame) next++;
      const after = known[next]!;
      const before = after > frame && next > 0 ? known[next - 1]! : after;
      const share = after > before ? (frame - before) / (after - before) : 0;
      for (let axis = 0; axis < 3; axis++) {
        const [a, b] = [before, after].map((at) => places[at * width + joint * 3 + axis]!) as [
          number,
          number,
        ];
        out[(frame * kept.length + to) * 3 + axis] = a + (b - a) * share;
      }
    }
  });
  const share = missing / (frames * kept.length);
  const warnings =
    share >= MENTIONED
      ? [
          `${Math.round(100 * share)} % of the places in this file are missing; joints go straight from the last place before to the next one.`,
        ]
      : [];
  // A parent that was never seen is none.
  const parentOf = (joint: number): number => kept.indexOf(joints[joint]!.parent);
  return {
    joints: kept.map((joint) => ({ ...joints[joint]!, parent: parentOf(joint) })),
    places: out,
    warnings,
  };
}
