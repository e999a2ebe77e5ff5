/**
 * The worker's side of the calls between the page and its workers, over comlink: a worker offers tasks by name with
 * `serve`; the page's side is run-in-worker.ts.
 */
import { type Endpoint, expose, releaseProxy, type Remote, transfer } from 'comlink';
import { AppError } from './error';

export interface TaskContext<Report> {
  /** Aborted when the page cancels this call. */
  readonly signal: AbortSignal;
  /**
   * Sends something to the page before the task ends, its buffers and pictures transferred; resolves when the page has
   * taken it.
   */
  report(this: void, report: Report): Promise<void>;
}

/** What a worker does on a call. It gives its output away: all buffers and pictures in it are transferred to the page. */
export type Task<Input, Output, Report = never> = (
  input: Input,
  context: TaskContext<Report>,
) => Output | Promise<Output>;

/** Tasks by name. */
export type Tasks = Readonly<Record<string, Task<never, unknown, never>>>;

/** Errors cross as data: a structured clone would lose code and hint. */
export type Outcome =
  | { readonly kind: 'done'; readonly output: unknown }
  | { readonly kind: 'refused'; readonly error: Pick<AppError, 'code' | 'message' | 'hint'> }
  | { readonly kind: 'cancelled' }
  /** Anything unforeseen, out of memory or a lost GPU for example; the worker is not to be used again. */
  | { readonly kind: 'crashed'; readonly reason: string };

export type Reporter = (report: unknown) => void | Promise<void>;

export interface TaskRunner {
  call(id: number, name: string, input: unknown, report: Reporter): Promise<Outcome>;
  cancel(id: number): void;
  /** Answered as soon as the worker's work lets messages in. */
  answer(): void;
}

/** In a worker: answers the page's calls, which come through `port`, with these tasks. */
export function serve(tasks: Tasks, port?: Endpoint): void {
  const running = new Map<number, AbortController>();
  const runner: TaskRunner = {
    async call(id, name, input, report) {
      const controller = new AbortController();
      running.set(id, controller);
      const { signal } = controller;
      let lastReport = Promise.resolve();
      const context: TaskContext<unknown> = {
        signal,
        report: (value) => {
          lastReport = Promise.resolve(report(handOver(value)));
          return lastReport;
        },
      };
      let outcome: Outcome;
      try {
        const task = tasks[name] as Task<unknown, unknown, unknown>;
        outcome = handOver({ kind: 'done', output: await task(input, context) });
      } catch (error) {
        outcome = failure(error, signal);
      } finally {
        running.delete(id);
      }
      // Reports go through a port of their own, which the outcome would overtake.
      await lastReport;
      // Its port would stay open until both threads have collected their garbage.
      (report as Remote<Reporter>)[releaseProxy]();
      return outcome;
    },
    cancel(id) {
      running.get(id)?.abort();
    },
    answer: () => undefined,
  };
  expose(runner, port);
}

function failure(error: unknown, signal: AbortSignal): Outcome {
  if (signal.aborted) return { kind: 'cancelled' };
  if (error instanceof AppError) {
    const { code, message, hint } = error;
    return { kind: 'refused', error: { code, message, hint } };
  }
  return { kind: 'crashed', reason: error instanceof Error ? error.message : String(error) };
}

/** Marks all that can be transferred of a value to be transferred with it. */
function handOver<T>(value: T): T {
  const parts = transferablesIn(value);
  return parts.size > 0 ? transfer(value, [...parts]) : value;
}

/** The buffers and pictures in a value of plain objects, arrays, typed arrays and pictures. */
export function transferablesIn(value: unknown): Set<ArrayBuffer | ImageBitmap> {
  const found = new Set<ArrayBuffer | ImageBitmap>();
  const collect = (part: unknown): void => {
    if (ArrayBuffer.isView(part)) {
      if (part.buffer instanceof ArrayBuffer) found.add(part.buffer);
    } else if (isPicture(part)) found.add(part);
    else if (typeof part === 'object' && part !== null) Object.values(part).forEach(collect);
  };
  collect(value);
  return found;
}

/** Node has no pictures. */
function isPicture(part: unknown): part is ImageBitmap {
  return 'ImageBitmap' in globalThis && part instanceof ImageBitmap;
}
