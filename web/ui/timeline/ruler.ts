import { el, setText, setVariable } from '../widgets/dom';
import { accentOf, type Accent, type BarAndCount, type CountedBeats, placeOf } from '../store/counting';
import { clockTime } from '../store/format';
import type { TimeScale } from '../store/time-scale';

/** The ruler over the lanes: bars, or seconds where there are no beats. */
interface RulerLane {
  readonly label: HTMLElement;
  readonly root: HTMLElement;
  readonly draw: (beats: CountedBeats, scale: TimeScale) => void;
}

export function createRulerLane(): RulerLane {
  const label = el('div', { class: 'lane-label ruler' });
  const markRow = el('div', { class: 'marks', attributes: { 'aria-hidden': 'true' } });
  const root = el('div', { class: 'lane ruler', attributes: { 'data-own-pointer': true } }, markRow);
  root.title = 'Drag to loop a part, click to jump, Alt and click where the “1” is';
  return {
    label,
    root,
    draw: (beats, scale) => {
      const { name, marks } = rulerMarks(beats, scale);
      setText(label, name);
      markRow.replaceChildren(
        ...marks.map(({ text, at, one }) => {
          const mark = el('span', { text, class: one ? 'one' : '' });
          setVariable(mark, '--at', at);
          return mark;
        }),
      );
    },
  };
}

/** What the ruler shows. */
interface RulerMarks {
  /** `Bars` or `Time`. */
  readonly name: string;
  /** Texts with their place in the picture, 0 to 1, and whether they are at a "1". */
  readonly marks: readonly { readonly text: string; readonly at: number; readonly one: boolean }[];
}

/** Least distance between two marks, CSS pixels. */
const MARK_DISTANCE = 40;
/** Width of a mark's text: of a bar, and of a time in seconds and in tenths, CSS pixels. */
const TEXT_WIDTH = 18;
const TIME_WIDTH = { seconds: 26, tenths: 36 } as const;
/** With fewer beats than this the ruler shows seconds. */
const MIN_BEATS = 8;

/**
 * The bars that begin with a "1", which is every second one; the others and the beats between them where there is
 * room; seconds where there are too few beats.
 */
export function rulerMarks(beats: CountedBeats, scale: TimeScale): RulerMarks {
  const { from, to, width } = scale;
  const seconds = to - from;
  if (seconds <= 0 || width <= 0) return { name: 'Time', marks: [] };
  if (beats.times.length < MIN_BEATS)
    return { name: 'Time', marks: timeMarks(scale, Math.max(1, Math.floor(width / MARK_DISTANCE))) };
  // A mark whose text would be cut off at the end is left out.
  const last = scale.time(width - TEXT_WIDTH);
  const seen = beats.times.flatMap((time, index) =>
    time >= from && time <= last ? [{ time, accent: accentOf(beats, index), ...placeOf(beats, index) }] : [],
  );
  const apart = scale.x(seen.at(-1)?.time ?? 0) - scale.x(seen[0]?.time ?? 0);
  const beatDistance = seen.length > 1 ? apart / (seen.length - 1) : MARK_DISTANCE;
  const every = nextOf([1, 2, 4, 8, 16, 32, 64], MARK_DISTANCE / (beats.beatsPerBar * beatDistance));
  const marked =
    beatDistance >= MARK_DISTANCE
      ? seen
      : seen.filter(({ bar, accent }) => bar > 0 && accent !== 'beat' && (bar - 1) % every === 0);
  return {
    name: 'Bars',
    marks: marked.map((beat) => ({
      text: markText(beat),
      at: scale.x(beat.time) / width,
      one: beat.accent === 'one',
    })),
  };
}

/** `3` where bar 3 begins, `3.2` at its second count; `·7` before the first bar. */
function markText({ bar, count, accent }: BarAndCount & { readonly accent: Accent }): string {
  if (bar < 1) return `·${count}`;
  return accent !== 'beat' ? String(bar) : `${bar}.${count}`;
}

function timeMarks({ from, to, x, width, time: timeAt }: TimeScale, maxMarks: number): RulerMarks['marks'] {
  const every = nextOf([0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300], (to - from) / maxMarks);
  const first = Math.ceil(from / every - 1e-6);
  const last = Math.floor(timeAt(width - TIME_WIDTH[every < 1 ? 'tenths' : 'seconds']) / every);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => {
    const time = (first + index) * every;
    return { text: clockTime(time, every < 1), at: x(time) / width, one: false };
  });
}

/** The first of the ascending steps that is at least `min`, or the last. */
function nextOf(steps: readonly number[], min: number): number {
  return steps.find((step) => step >= min) ?? steps.at(-1) ?? 1;
}
