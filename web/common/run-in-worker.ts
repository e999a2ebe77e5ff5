/**
 * The page's side of the calls between the page and its workers, over comlink: it calls the tasks that a worker serves
 * (serve-tasks.ts) through a `WorkerConnection`, or with `runInWorker` where each call gets a worker of its own.
 */
import { proxy, releaseProxy, type Remote, transfer, wrap } from 'comlink';
import { AppError } from './error';
import { explainedByVersion, pagePartMissing } from './page-part';
import {
  type Outcome,
  type Reporter,
  type TaskContext,
  type TaskRunner,
  type Tasks,
  transferablesIn,
} from './serve-tasks';
import { type Timeouts, Watchdog } from './watchdog';

type InputOf<T extends Tasks[string]> = Parameters<T>[0];
type OutputOf<T extends Tasks[string]> = Awaited<ReturnType<T>>;
type ReportOf<T extends Tasks[string]> = Parameters<T>[1] extends TaskContext<infer R> ? R : never;

interface CallOptions<Report = never> {
  /** Cancels the call. */
  readonly signal?: AbortSignal | undefined;
  /** Where it returns a promise, the worker's `report` resolves after that. */
  readonly onReport?: ((report: Report) => unknown) | undefined;
  /** Buffers of the input that are handed to the worker instead of copied. */
  readonly transfers?: readonly ArrayBufferLike[] | undefined;
}

/**
 * How long a worker with work may be silent. No task holds its thread for more than three seconds without a
 * report (opening a graph is the longest), so this leaves room for machines that are twenty times slower.
 */
const WORKER_TIMEOUTS: Timeouts = { first: 60, next: 60 };

/** How browsers and onnxruntime say that memory cannot be had. */
const NO_MEMORY = /bad_alloc|out of memory|\bOOM\b|allocation failed|could not allocate|maximum memory size/i;

function outOfMemory(): AppError {
  return new AppError(
    'out-of-memory',
    'This device has no memory left for that.',
    'Close other tabs and programs, then try again; a shorter song and leader need less.',
  );
}

/** Frees the pictures of what came too late: until they are collected as garbage they would keep their memory. */
function closePictures(value: unknown): void {
  for (const part of transferablesIn(value)) if ('close' in part) part.close();
}

/**
 * Hands the reports of a call on until it ends. The port that they come through may outlive the call, so it holds
 * nothing of it.
 */
class Reports {
  #onReport: ((report: unknown) => unknown) | undefined;
  readonly #resetWatchdog: () => void;
  #ended = false;

  constructor(resetWatchdog: () => void, onReport: ((report: unknown) => unknown) | undefined) {
    this.#resetWatchdog = resetWatchdog;
    this.#onReport = onReport;
  }

  readonly take: Reporter = async (report) => {
    this.#resetWatchdog();
    if (this.#onReport) await this.#onReport(report);
    else closePictures(report);
  };

  get ended(): boolean {
    return this.#ended;
  }

  end(): void {
    this.#ended = true;
    this.#onReport = undefined;
  }
}

interface ConnectionOptions {
  /** Makes the error of a crash, given its reason in the browser's words. */
  readonly toError?: ((reason: string) => Error) | undefined;
  readonly timeouts?: Timeouts | undefined;
}

/** A worker that answers many calls, until it crashes, falls silent or is disposed of. */
export class WorkerConnection<T extends Tasks> {
  readonly #worker: Worker;
  readonly #remote: Remote<TaskRunner>;
  readonly #toError: (reason: string) => Error;
  /** Fail the calls under way when the worker ends, so that none waits for its answer for ever. */
  readonly #failures = new Set<(error: Error) => void>();
  /** Why the worker ended; null while it has not. */
  #end: Error | null = null;
  #calls = 0;
  /** Calls that the worker has not answered, cancelled ones among them. */
  #unanswered = 0;
  readonly #watchdog: Watchdog;

  constructor(
    worker: Worker,
    { toError = (reason) => new Error(reason), timeouts = WORKER_TIMEOUTS }: ConnectionOptions = {},
  ) {
    this.#worker = worker;
    this.#remote = wrap<TaskRunner>(worker);
    this.#toError = (reason) => (NO_MEMORY.test(reason) ? outOfMemory() : toError(reason));
    this.#watchdog = new Watchdog(
      timeouts,
      () => this.#remote.answer(),
      (seconds) => this.dispose(this.#toError(`no answer for ${seconds} seconds`)),
    );
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      if (event.message) this.dispose(this.#toError(event.message));
      // Only a script that could not be loaded gives no reason.
      else void explainedByVersion(pagePartMissing()).then((error) => this.dispose(error));
    });
    worker.addEventListener('messageerror', () => this.dispose(this.#toError('a message could not be read')));
  }

  /** True after a crash, silence or `dispose`: calls fail. */
  get ended(): boolean {
    return this.#end !== null;
  }

  /**
   * Has the worker do a task.
   * @throws the task's {AppError}, or `newer-version` where that explains it; the error of a crash; the signal's reason,
   * at once, while the worker hears of it when its task next lets messages in
   */
  async call<K extends keyof T & string>(
    name: K,
    input: InputOf<T[K]>,
    { signal, onReport, transfers = [] }: CallOptions<ReportOf<T[K]>> = {},
  ): Promise<OutputOf<T[K]>> {
    signal?.throwIfAborted();
    if (this.#end) throw this.#end;
    const id = ++this.#calls;
    const reports = new Reports(this.#watchdog.reset, onReport as ((report: unknown) => unknown) | undefined);
    const report = proxy(reports.take);
    let cancel: () => void = () => undefined;
    let fail: (error: Error) => void = () => undefined;
    try {
      // Not a race with a promise that lives as long as the worker: it would hold on to the output of every call.
      const outcome = await new Promise<Outcome>((resolve, reject) => {
        fail = reject;
        cancel = () => {
          if (!this.#end) void this.#remote.cancel(id);
          reject(signal?.reason as Error);
        };
        this.#failures.add(fail);
        signal?.addEventListener('abort', cancel);
        const call = this.#remote.call(id, name, transfer(input, [...transfers] as ArrayBuffer[]), report);
        this.#watchUntil(call);
        call.then((late) => {
          if (reports.ended) closePictures(late);
          else resolve(late);
        }, reject);
      });
      if (outcome.kind === 'done') return outcome.output as OutputOf<T[K]>;
      throw await explainedByVersion(this.#errorOf(outcome));
    } finally {
      reports.end();
      this.#failures.delete(fail);
      signal?.removeEventListener('abort', cancel);
    }
  }

  /** Expects signs of life until the worker has answered, also where a cancelled call is no longer waited for. */
  #watchUntil(call: Promise<unknown>): void {
    this.#unanswered++;
    this.#watchdog.start();
    const answered = (): void => {
      this.#watchdog.reset();
      if (--this.#unanswered === 0) this.#watchdog.stop();
    };
    call.then(answered, answered);
  }

  #errorOf(outcome: Exclude<Outcome, { kind: 'done' }>): Error {
    switch (outcome.kind) {
      case 'refused':
        return new AppError(outcome.error.code, outcome.error.message, outcome.error.hint);
      case 'cancelled':
        return new DOMException('Cancelled.', 'AbortError');
      case 'crashed': {
        const error = this.#toError(outcome.reason);
        this.dispose(error);
        return error;
      }
    }
  }

  /** Ends the worker; calls under way are rejected with `reason`. */
  dispose(reason: Error = new DOMException('The worker was ended.', 'AbortError')): void {
    this.#watchdog.stop();
    // Comlink's registry of proxies holds the worker, whose listeners hold the proxy: it would never be collected.
    if (!this.#end) this.#remote[releaseProxy]();
    this.#end ??= reason;
    this.#worker.terminate();
    for (const fail of this.#failures) fail(this.#end);
  }
}

/**
 * Does one task in a worker of its own, which is ended with it: at once when the signal is aborted.
 * @throws as `WorkerConnection.call`
 */
export async function runInWorker<T extends Tasks, K extends keyof T & string>(
  worker: Worker,
  name: K,
  input: InputOf<T[K]>,
  options: CallOptions<ReportOf<T[K]>> & ConnectionOptions = {},
): Promise<OutputOf<T[K]>> {
  const connection = new WorkerConnection<T>(worker, options);
  try {
    return await connection.call(name, input, options);
  } finally {
    connection.dispose();
  }
}
