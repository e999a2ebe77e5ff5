/** What client and worker say to each other. Errors cross as data: a structured clone would lose code and hint. */
import type { SolvedMotion } from '../motion/skeleton/clip';
import type { Backend } from './load/backend';
import { AppError, type ErrorCode } from '../common/error';
import type { CoarseRequest, GenerateRequest } from './sample/inputs';
import type { LoadOptions, Status } from './load/load';
import type { Manifest } from './manifest';
import type { GenerateResult, Preview } from './sample/pipeline';
import type { Progress } from './progress';

export type Failure =
  | { readonly kind: 'model'; readonly code: ErrorCode; readonly message: string; readonly hint: string }
  | { readonly kind: 'cancelled' }
  /** Anything nobody foresaw, out of memory or a lost GPU for example; the worker is not to be used again. */
  | { readonly kind: 'crash'; readonly message: string };

export type Outcome<T> =
  { readonly ok: true; readonly value: T } | { readonly ok: false; readonly failure: Failure };

/** Everything the worker says unasked, through one callback for its whole life. */
export type WorkerEvent =
  | { readonly kind: 'status'; readonly status: Status }
  | { readonly kind: 'progress'; readonly id: number; readonly progress: Progress }
  | { readonly kind: 'preview'; readonly id: number; readonly preview: Preview };

export interface ModelWorker {
  load(
    options: LoadOptions,
    onEvent: (event: WorkerEvent) => void,
  ): Promise<Outcome<{ manifest: Manifest; backend: Backend }>>;
  /** `at`: the frame that someone looks at, where a preview is wanted. */
  generate(id: number, request: GenerateRequest, at: number | null): Promise<Outcome<GenerateResult>>;
  coarse(id: number, request: CoarseRequest): Promise<Outcome<SolvedMotion>>;
  cancel(id: number): void;
}

export async function outcome<T>(job: () => Promise<T>, signal?: AbortSignal): Promise<Outcome<T>> {
  try {
    return { ok: true, value: await job() };
  } catch (error) {
    if (signal?.aborted === true) return { ok: false, failure: { kind: 'cancelled' } };
    if (error instanceof AppError) {
      const { code, message, hint } = error;
      return { ok: false, failure: { kind: 'model', code, message, hint } };
    }
    return {
      ok: false,
      failure: { kind: 'crash', message: error instanceof Error ? error.message : String(error) },
    };
  }
}
