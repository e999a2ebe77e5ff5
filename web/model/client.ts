import { proxy, type Remote, wrap } from 'comlink';
import type { SolvedMotion } from '../motion/skeleton/clip';
import type { Backend, Preference } from './load/backend';
import { AppError } from '../common/error';
import type { ModelFolder } from './load/folder';
import type { CoarseRequest, GenerateRequest } from './sample/inputs';
import type { Status } from './load/load';
import type { Manifest } from './manifest';
import type { DownloadPart } from './load/assets';
import type { GenerateOptions, GenerateResult, Made, Preview } from './sample/pipeline';
import type { Progress } from './progress';
import type { Failure, ModelWorker, Outcome, WorkerEvent } from './protocol';

export type {
  Backend,
  CoarseRequest,
  DownloadPart,
  GenerateOptions,
  GenerateRequest,
  GenerateResult,
  Made,
  Manifest,
  ModelFolder,
  Preference,
  Preview,
  Progress,
  Status,
};

export interface GeneratorOptions {
  /** Address of the model's manifest.json. */
  readonly manifestUrl: string;
  /** The model's files, where they come from the visitor and not from the address. */
  readonly folder?: ModelFolder | undefined;
  /** Where to compute; 'auto' when not given. */
  readonly backend?: Preference | undefined;
  /** So many wasm threads instead of as many as suit the machine; for measuring. */
  readonly threads?: number | undefined;
  readonly onStatus?: ((status: Status) => void) | undefined;
}

/** The page's way to the model: one worker with one model, replaced by a fresh one after a crash. */
export interface Generator {
  readonly manifest: Manifest;
  /** Where the present worker computes, and why. */
  readonly backend: Backend;
  /**
   * Compute the partner of a dancer.
   * @throws {AppError}
   * @throws the signal's reason, soon after it is aborted
   */
  generate(request: GenerateRequest, options?: GenerateOptions): Promise<GenerateResult>;
  /**
   * Compute the partner that the coarse layer alone of a reaction says.
   * @throws {AppError}
   * @throws the signal's reason, soon after it is aborted
   */
  coarse(request: CoarseRequest, options?: Pick<GenerateOptions, 'signal'>): Promise<SolvedMotion>;
  /** Ends the worker; calls under way are rejected. */
  dispose(): void;
}

/** A worker with a loaded model. */
interface Running {
  readonly remote: Remote<ModelWorker>;
  readonly manifest: Manifest;
  readonly backend: Backend;
  /** Is rejected when the worker dies, so that nobody waits for its answer for ever. */
  readonly death: Promise<never>;
  /** Who wants to hear of each call under way. */
  readonly listeners: Map<number, Pick<GenerateOptions, 'onProgress' | 'onPreview'>>;
  end(error: Error): void;
}

function crashed(message: string): AppError {
  return new AppError(
    'worker-crashed',
    `The model stopped unexpectedly: ${message}`,
    'Try again, it starts afresh; if it stops again, use a shorter clip or the processor instead of WebGPU.',
  );
}

function toError(failure: Failure): Error {
  if (failure.kind === 'model') return new AppError(failure.code, failure.message, failure.hint);
  if (failure.kind === 'crash') return crashed(failure.message);
  return new DOMException('Cancelled.', 'AbortError');
}

async function start(options: GeneratorOptions): Promise<Running> {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'model' });
  const remote = wrap<ModelWorker>(worker);
  const listeners: Running['listeners'] = new Map();
  let reject: (error: Error) => void = () => undefined;
  const death = new Promise<never>((_, fail) => (reject = fail));
  // Whoever waits races against it; when nobody does, a death is noticed at the next call.
  death.catch(() => undefined);
  const end = (error: Error): void => {
    worker.terminate();
    reject(error);
  };
  worker.addEventListener('error', (event) => {
    end(crashed(event.message || 'its script could not be loaded'));
  });
  worker.addEventListener('messageerror', () => {
    end(crashed('a message could not be read'));
  });
  const onEvent = (event: WorkerEvent): void => {
    if (event.kind === 'status') options.onStatus?.(event.status);
    else if (event.kind === 'preview') listeners.get(event.id)?.onPreview?.(event.preview);
    else listeners.get(event.id)?.onProgress?.(event.progress);
  };
  const { folder, backend = 'auto', threads } = options;
  const manifestUrl = new URL(options.manifestUrl, document.baseURI).href;
  const loaded = await Promise.race([
    remote.load({ manifestUrl, folder, backend, threads }, proxy(onEvent)),
    death,
  ]);
  if (!loaded.ok) {
    const error = toError(loaded.failure);
    end(error);
    throw error;
  }
  return { remote, ...loaded.value, death, listeners, end };
}

/**
 * Start the model's worker and load the model into it.
 * @throws {AppError}
 */
export async function createGenerator(options: GeneratorOptions): Promise<Generator> {
  let latest = await start(options);
  let current: Promise<Running> | undefined;
  let calls = 0;
  let disposed = false;

  const use = (running: Running): void => {
    latest = running;
    running.death.catch(() => {
      if (latest === running) current = undefined;
    });
  };
  /** The present worker, or a fresh one after a crash. */
  const ready = (): Promise<Running> => {
    current ??= start(options).then(
      (running) => {
        use(running);
        return running;
      },
      (error: unknown) => {
        current = undefined;
        throw error;
      },
    );
    return current;
  };
  current = Promise.resolve(latest);
  use(latest);

  /** Has the worker do something, with its progress told and cancelled when the signal says so. */
  async function call<T>(
    { signal, onProgress, onPreview }: GenerateOptions,
    ask: (remote: Running['remote'], id: number) => Promise<Outcome<T>>,
  ): Promise<T> {
    if (disposed) throw new DOMException('The generator was disposed.', 'AbortError');
    signal?.throwIfAborted();
    const running = await ready();
    signal?.throwIfAborted();
    const id = ++calls;
    running.listeners.set(id, { onProgress, onPreview });
    let cancel: () => void = () => undefined;
    // The caller hears at once; the worker stops when its present graph run is over.
    const cancelled = new Promise<never>((_, fail) => {
      cancel = () => {
        void running.remote.cancel(id);
        fail(signal?.reason as Error);
      };
    });
    signal?.addEventListener('abort', cancel);
    let result: Outcome<T>;
    try {
      result = await Promise.race([ask(running.remote, id), running.death, cancelled]);
    } finally {
      signal?.removeEventListener('abort', cancel);
      running.listeners.delete(id);
    }
    if (result.ok) return result.value;
    const error = toError(result.failure);
    if (result.failure.kind === 'crash') running.end(error);
    throw error;
  }

  return {
    get manifest() {
      return latest.manifest;
    },
    get backend() {
      return latest.backend;
    },
    generate: (request, { at, ...options } = {}) =>
      call(options, (remote, id) => remote.generate(id, request, options.onPreview ? (at ?? null) : null)),
    coarse: (request, options = {}) => call(options, (remote, id) => remote.coarse(id, request)),
    dispose() {
      disposed = true;
      latest.end(new DOMException('The generator was disposed.', 'AbortError'));
    },
  };
}
