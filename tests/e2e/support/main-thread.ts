/** Times of one task of the main thread, milliseconds. */
export interface Task {
  /** From beginning to end, as `longtask` entries have it. */
  readonly whole: number;
  /** CPU time: without waiting, and without the time that other programs had the core. */
  readonly busy: number;
  /** Time waiting for the graphics card: in scripts of the page, and to bring frames on the screen. */
  readonly waited: { readonly inScripts: number; readonly onScreen: number };
}

/** The kinds of events that `tasksOf` reads. */
export const TRACED = ['toplevel', 'gpu', 'devtools.timeline', 'blink.user_timing'];

/** One event of a trace (Chromium's trace event format), microseconds. */
interface Traced {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  readonly ts: number;
  readonly dur?: number;
  /** Of `dur`, what the thread computed. */
  readonly tdur?: number;
}

const RUN_TASK = 'ThreadControllerImpl::RunTask';
/** What was awaited goes on in microtasks, which Chromium runs after the task that they belong to. */
const MICROTASKS = 'BlinkScheduler_PerformMicrotaskCheckpoint';

/**
 * The tasks of the main thread between two performance marks, each with the microtasks after it, from a trace of
 * Chromium.
 *
 * @param from name of the performance mark at the beginning
 * @param to name of the one at the end
 * @throws when the trace has no such marks
 */
export function tasksOf(trace: Buffer, from: string, to: string): Task[] {
  const { traceEvents } = JSON.parse(trace.toString()) as { traceEvents: readonly Traced[] };
  const mark = (name: string): Traced => {
    const found = traceEvents.find((event) => event.name === name);
    if (!found) throw new Error(`The trace has no mark "${name}".`);
    return found;
  };
  const [begin, end] = [mark(from), mark(to)];
  const events = traceEvents
    .filter(
      ({ ph, pid, tid, ts }) =>
        ph === 'X' && pid === begin.pid && tid === begin.tid && ts >= begin.ts && ts <= end.ts,
    )
    .toSorted((a, b) => a.ts - b.ts);
  const scripts = events.filter(({ name }) => name === 'FunctionCall' || name === 'FireAnimationFrame');
  const waits = events.filter(({ name }) => name.startsWith('CommandBufferProxyImpl::Wait'));
  return withMicrotasks(events).map((parts) => {
    const here = waits.filter((wait) => parts.some((part) => within(wait, part)));
    const scripted = here.filter((wait) => scripts.some((script) => within(wait, script)));
    const [whole, all, inScripts] = [parts, here, scripted].map((some) =>
      sum(some.map(({ dur = 0 }) => dur)),
    );
    return {
      whole: whole! / 1000,
      // The shortest tasks have no CPU time in the trace.
      busy: sum(parts.map(({ tdur = 0 }) => tdur)) / 1000,
      waited: { inScripts: inScripts! / 1000, onScreen: (all! - inScripts!) / 1000 },
    };
  });
}

/** Of one thread's events, in their order, those of every task: itself, and the microtasks after it. */
function withMicrotasks(events: readonly Traced[]): Traced[][] {
  const tasks: Traced[][] = [];
  for (const event of events) {
    const last = tasks.at(-1);
    if (event.name === RUN_TASK) tasks.push([event]);
    // Those that a task has run itself are within its time.
    else if (event.name === MICROTASKS && last && !within(event, last[0]!)) last.push(event);
  }
  return tasks;
}

const within = (inner: Traced, outer: Traced): boolean =>
  inner.ts >= outer.ts && inner.ts + (inner.dur ?? 0) <= outer.ts + (outer.dur ?? 0);

const sum = (numbers: readonly number[]): number => numbers.reduce((all, one) => all + one, 0);
