import { clockTime } from '../store/format';
import type { TimeScale } from '../store/time-scale';

export interface Ruler {
  readonly name: string;
  /** Texts with their place in the picture, 0 to 1. */
  readonly marks: readonly { readonly text: string; readonly at: number }[];
}

/** Room that a mark needs, CSS pixels. */
const ROOM = 40;
/** Room that a mark's own number needs, CSS pixels. */
const CUT = 18;

/**
 * Bars counted in four from the first beat, with the counts between them where there is room; seconds where there is
 * no beat to count.
 * @param beats seconds of the dance, ascending
 */
export function rulerMarks(beats: readonly number[], scale: TimeScale): Ruler {
  const { from, to, width } = scale;
  const seconds = to - from;
  if (seconds <= 0 || width <= 0) return { name: 'Time', marks: [] };
  if (beats.length < 8)
    return { name: 'Time', marks: timeMarks(scale, Math.max(1, Math.floor(width / ROOM))) };
  // A mark so near the end that its number would be cut off is left out.
  const last = scale.time(width - CUT);
  const seen = beats.flatMap((time, index) => (time >= from && time <= last ? [{ time, index }] : []));
  const bars = seen.filter(({ index }) => index % 4 === 0);
  const place = (time: number): number => scale.x(time) / width;
  const apart = scale.x(seen.at(-1)?.time ?? 0) - scale.x(seen[0]?.time ?? 0);
  const beatRoom = seen.length > 1 ? apart / (seen.length - 1) : ROOM;
  if (beatRoom >= ROOM)
    return {
      name: 'Bars',
      marks: seen.map(({ time, index }) => ({ text: barAndCount(index), at: place(time) })),
    };
  const every = nextOf([1, 2, 4, 8, 16, 32, 64], ROOM / (4 * beatRoom));
  const marks = bars.flatMap(({ time, index }) =>
    (index / 4) % every === 0 ? [{ text: String(index / 4 + 1), at: place(time) }] : [],
  );
  return { name: 'Bars', marks };
}

/** `3` where bar 3 begins, `3.2` at its second count. */
function barAndCount(beat: number): string {
  const bar = String(Math.floor(beat / 4) + 1);
  return beat % 4 === 0 ? bar : `${bar}.${(beat % 4) + 1}`;
}

function timeMarks({ from, to, x, width }: TimeScale, most: number): Ruler['marks'] {
  const every = nextOf([0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300], (to - from) / most);
  const first = Math.ceil(from / every - 1e-6);
  const last = Math.floor((to - 1e-6) / every);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => {
    const time = (first + index) * every;
    return { text: clockTime(time, every < 1), at: x(time) / width };
  });
}

/** The first of the ascending steps that is at least `least`, or the last. */
function nextOf(steps: readonly number[], least: number): number {
  return steps.find((step) => step >= least) ?? steps.at(-1) ?? 1;
}
