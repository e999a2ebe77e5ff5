import { AppError } from '../common/error';
import { newerVersion } from '../common/page-part';
import { WorkerConnection } from '../common/run-in-worker';
import type { Backend, Preference } from './load/backend';
import type { ModelFolder } from './load/download';
import {
  type CoarseRequest,
  type GenerateRequest,
  HEIGHTS,
  SEEDS,
  sameSource,
  type SeedsRequest,
  type Source,
} from './sample/inputs';
import { type Playhead, secondsNow } from './sample/playhead';
import type { Status } from './load/load';
import type { Manifest } from './manifest';
import type { DownloadPart } from './load/assets';
import type {
  GeneratedMotion,
  GenerateOptions,
  GenerateResult,
  Preview,
  SeedsOptions,
} from './sample/results';
import type { Progress } from './progress';
import type { Loaded, ModelTasks } from './worker';

export type {
  Backend,
  CoarseRequest,
  DownloadPart,
  GeneratedMotion,
  GenerateOptions,
  GenerateRequest,
  GenerateResult,
  Manifest,
  ModelFolder,
  Playhead,
  Preference,
  Preview,
  Progress,
  SeedsOptions,
  SeedsRequest,
  Status,
};

export interface GeneratorOptions {
  /** Address of the model's manifest.json. */
  readonly manifestUrl: string;
  /** The model's files, where the visitor chose them; by default they are fetched from beside the manifest. */
  readonly folder?: ModelFolder | undefined;
  /** Where to compute; 'auto' when not given. */
  readonly backend?: Preference | undefined;
  /** Number of wasm threads, for measurements; by default as many as suit the machine. */
  readonly threads?: number | undefined;
  /**
   * Called while a model is loaded, which is also done again after a crash. Its graphs are downloaded after the promise
   * that it returns for the status `manifest`, and opened after the one for `open`.
   */
  readonly onStatus?: ((status: Status | ReloadFailure) => unknown) | undefined;
}

/** A model that was there could not be loaded again. */
export interface ReloadFailure {
  readonly kind: 'failed';
  readonly error: unknown;
}

/** Generates reactions for the page in a worker of its own, which is replaced after a crash. */
export interface Generator {
  readonly manifest: Manifest;
  /** Where the current worker computes, and why. */
  readonly backend: Backend;
  /**
   * Generates the reaction to a leader, or the leader of a reactor.
   * @throws {AppError}
   * @throws the signal's reason, soon after it is aborted
   */
  generate(request: GenerateRequest, options?: GenerateOptions): Promise<GenerateResult>;
  /**
   * Samples dances of several seeds and finds the seeds of those that differ most.
   * @throws {AppError}
   * @throws the signal's reason, soon after it is aborted
   */
  differingSeeds(request: SeedsRequest, options?: SeedsOptions): Promise<number[]>;
  /**
   * Decodes the coarse layer of a reaction without the fine one.
   * @throws {AppError}
   * @throws the signal's reason, soon after it is aborted
   */
  coarse(request: CoarseRequest, options?: Pick<GenerateOptions, 'signal'>): Promise<GeneratedMotion>;
  /** Ends the worker; calls under way are rejected. */
  dispose(): void;
}

export { HEIGHTS, SEEDS, secondsNow };

/** A worker with a loaded model. */
interface LoadedWorker extends Loaded {
  readonly connection: WorkerConnection<ModelTasks>;
  /** What it was told last is danced to. */
  source: Source | null;
}

function crashed(message: string): AppError {
  return new AppError(
    'worker-crashed',
    `The model stopped unexpectedly: ${message}`,
    'Try again, it starts afresh; if it stops again, use a shorter clip or the processor instead of WebGPU.',
  );
}

interface StartOptions extends GeneratorOptions {
  /** As in `LoadOptions`. */
  readonly processorBecause?: string;
}

async function start(options: StartOptions): Promise<LoadedWorker> {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'model' });
  const connection = new WorkerConnection<ModelTasks>(worker, { toError: crashed });
  const { folder, backend = 'auto', threads, processorBecause } = options;
  const manifestUrl = new URL(options.manifestUrl, document.baseURI).href;
  try {
    const loaded = await connection.call(
      'load',
      { manifestUrl, folder, backend, threads, processorBecause },
      { onReport: options.onStatus },
    );
    return { connection, source: null, ...loaded };
  } catch (error) {
    connection.dispose();
    throw error;
  }
}

class WorkerGenerator implements Generator {
  /** The last worker that was loaded; it may have crashed since. */
  #latest: LoadedWorker;
  /** Its replacement while that is being loaded. */
  #next: Promise<LoadedWorker> | undefined;
  #disposed = false;
  #options: StartOptions;

  constructor(first: LoadedWorker, options: GeneratorOptions) {
    this.#latest = first;
    this.#options = options;
  }

  get manifest(): Manifest {
    return this.#latest.manifest;
  }

  get backend(): Backend {
    return this.#latest.backend;
  }

  async generate(
    { leader, fitted, music, role, ...settings }: GenerateRequest,
    { signal, playhead, onProgress, onPreview }: GenerateOptions = {},
  ): Promise<GenerateResult> {
    return this.#onWorker(signal, (worker) =>
      worker.connection.call(
        'generate',
        {
          source: newSource(worker, { leader, fitted, music, role }, signal),
          settings,
          playhead: onPreview && playhead,
        },
        {
          signal,
          onReport: (report) => {
            if (report.kind === 'progress') onProgress?.(report.progress);
            else void onPreview?.(report.preview);
          },
        },
      ),
    );
  }

  async differingSeeds(
    { request, ...seeds }: SeedsRequest,
    { signal, onProgress }: SeedsOptions = {},
  ): Promise<number[]> {
    const { leader, fitted, music, role, ...settings } = request;
    return this.#onWorker(signal, (worker) =>
      worker.connection.call(
        'differingSeeds',
        { source: newSource(worker, { leader, fitted, music, role }, signal), settings, seeds },
        { signal, onReport: onProgress },
      ),
    );
  }

  async coarse(
    request: CoarseRequest,
    { signal }: Pick<GenerateOptions, 'signal'> = {},
  ): Promise<GeneratedMotion> {
    return this.#onWorker(signal, ({ connection }) => connection.call('coarse', request, { signal }));
  }

  /** Makes a call on the current worker; where that loses its GPU, again on one that computes on the processor. */
  async #onWorker<T>(
    signal: AbortSignal | undefined,
    call: (worker: LoadedWorker) => Promise<T>,
  ): Promise<T> {
    const worker = await this.#ready(signal);
    try {
      return await call(worker);
    } catch (error) {
      if (!(error instanceof AppError && error.code === 'gpu-lost')) throw error;
      this.#leaveGpu(worker, error);
      return call(await this.#ready(signal));
    }
  }

  /** Ends a worker that has lost its GPU; its calls under way are rejected with the same error and made again. */
  #leaveGpu({ connection }: LoadedWorker, loss: AppError): void {
    if (connection.ended) return;
    connection.dispose(loss);
    const processorBecause = loss.message.replace(/\.$/, '');
    this.#options = { ...this.#options, backend: 'wasm', processorBecause };
    this.#options.onStatus?.({
      kind: 'notice',
      code: 'gpu-lost',
      message: loss.message,
      hint: 'The dance is computed on the processor from now on. Reload the page to try the graphics card again.',
    });
  }

  /** The current worker, or a new one after a crash. */
  async #ready(signal: AbortSignal | undefined): Promise<LoadedWorker> {
    if (this.#disposed) throw disposal();
    signal?.throwIfAborted();
    if (this.#latest.connection.ended) {
      this.#next ??= this.#restart().finally(() => (this.#next = undefined));
      this.#latest = await this.#next;
      if (this.#disposed) this.dispose();
      signal?.throwIfAborted();
    }
    return this.#latest;
  }

  /** @throws {AppError} `newer-version` where the server has another model by now: settings and takes are of this one */
  async #restart(): Promise<LoadedWorker> {
    try {
      const worker = await start(this.#options);
      if (JSON.stringify(worker.manifest) === JSON.stringify(this.manifest)) return worker;
      worker.connection.dispose();
      throw newerVersion();
    } catch (error) {
      this.#options.onStatus?.({ kind: 'failed', error });
      throw error;
    }
  }

  dispose(): void {
    this.#disposed = true;
    this.#latest.connection.dispose(disposal());
  }
}

/**
 * What is danced to, or null where the worker has it: a megabyte a minute, copied at every step of a fader otherwise.
 * @throws the signal's reason: a call that is cancelled before it is made tells the worker nothing
 */
function newSource(worker: LoadedWorker, source: Source, signal: AbortSignal | undefined): Source | null {
  signal?.throwIfAborted();
  const known = worker.source !== null && sameSource(worker.source, source);
  worker.source = source;
  return known ? null : source;
}

function disposal(): DOMException {
  return new DOMException('The generator was disposed.', 'AbortError');
}

/**
 * Start the model's worker and load the model into it.
 * @throws {AppError}
 */
export async function createGenerator(options: GeneratorOptions): Promise<Generator> {
  return new WorkerGenerator(await start(options), options);
}
