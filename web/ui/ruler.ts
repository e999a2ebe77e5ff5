import { clockTime } from './format';

export interface Ruler {
  readonly name: string;
  /** Texts with their place, 0 to 1. */
  readonly marks: readonly { readonly text: string; readonly at: number }[];
}

/** Room that a mark needs, CSS pixels. */
const ROOM = 40;
/** Room that a mark's own number needs, CSS pixels. */
const CUT = 18;

/** Bars counted in four from the first beat; seconds where there is no beat to count. */
export function rulerMarks(beats: readonly number[], seconds: number, width: number): Ruler {
  if (seconds <= 0 || width <= 0) return { name: 'Time', marks: [] };
  const most = Math.max(1, Math.floor(width / ROOM));
  if (beats.length < 8) return { name: 'Time', marks: timeMarks(seconds, most) };
  // A mark so near the end that its number would be cut off is left out.
  const last = seconds * (1 - CUT / width);
  const bars = beats.filter((beat, index) => index % 4 === 0 && beat <= last);
  const every = nextOf([1, 2, 4, 8, 16, 32, 64], bars.length / most);
  const marks = bars.flatMap((beat, bar) =>
    bar % every === 0 ? [{ text: String(bar + 1), at: beat / seconds }] : [],
  );
  return { name: 'Bars', marks };
}

function timeMarks(seconds: number, most: number): Ruler['marks'] {
  const every = nextOf([1, 2, 5, 10, 15, 30, 60, 120, 300], seconds / most);
  return Array.from({ length: Math.floor((seconds - 1e-6) / every) + 1 }, (_, index) => ({
    text: clockTime(index * every, false),
    at: (index * every) / seconds,
  }));
}

/** The first of the ascending steps that is at least `least`, or the last. */
function nextOf(steps: readonly number[], least: number): number {
  return steps.find((step) => step >= least) ?? steps.at(-1) ?? 1;
}
