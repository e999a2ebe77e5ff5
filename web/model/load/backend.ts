import { inTime } from './in-time';
import type { Provider } from './runtime';

export type Preference = 'auto' | Provider;

/** Where the graphs run, and why, in words for the page. */
export interface Backend {
  readonly name: Provider;
  readonly reason: string;
  /** Threads of the wasm runtime; with WebGPU they only run the few operations that stay on the CPU. */
  readonly threads: number;
}

/** What the browser offers, as far as the choice depends on it. */
export interface Environment {
  readonly gpu?: Pick<GPU, 'requestAdapter'> | undefined;
  readonly isSecureContext: boolean;
  readonly crossOriginIsolated: boolean;
  readonly hardwareConcurrency: number;
}

/** Longest time for WebGPU to find an adapter, milliseconds: a stuck graphics driver may never answer. */
const ADAPTER_MS = 10_000;

/** More threads gain little on matrices of this size. */
const MAX_THREADS = 4;

export function environment(scope: typeof globalThis): Environment {
  const navigator = scope.navigator as Navigator & { gpu?: GPU };
  return {
    gpu: navigator.gpu,
    isSecureContext: scope.isSecureContext,
    crossOriginIsolated: scope.crossOriginIsolated,
    hardwareConcurrency: navigator.hardwareConcurrency,
  };
}

/**
 * Threads share memory, which a page has only when it is cross-origin isolated. One core is left to the page:
 * without a GPU for the model the stage is often rendered by the processor too. On two cores a generation takes a
 * third longer for it, and twice as many frames are rendered meanwhile.
 */
function wasmThreads(environment: Environment, asked?: number): number {
  if (!environment.crossOriginIsolated) return 1;
  return asked ?? Math.max(1, Math.min(environment.hardwareConcurrency - 1, MAX_THREADS));
}

/** Chromium before 127 has no `info`. */
type Adapter = Partial<Pick<GPUAdapter, 'info'>>;

/** The adapter, or the reason why there is none worth using. */
async function probe(
  { gpu, isSecureContext }: Environment,
  software: boolean,
): Promise<{ adapter: Adapter } | { without: string }> {
  if (gpu === undefined)
    return {
      without: isSecureContext
        ? 'this browser has no WebGPU'
        : 'WebGPU works over https or on localhost only',
    };
  let adapter: Adapter | null;
  try {
    adapter = await inTime(gpu.requestAdapter({ powerPreference: 'high-performance' }), ADAPTER_MS);
  } catch (error) {
    return { without: `WebGPU could not be asked for a graphics adapter (${String(error)})` };
  }
  if (adapter === null) return { without: 'WebGPU found no graphics adapter' };
  if (adapter.info?.isFallbackAdapter && !software) {
    return { without: 'WebGPU found only a software adapter, which is slower than the processor itself' };
  }
  return { adapter };
}

/** Name of the hardware, as far as the browser gives it. */
function describe(info: Adapter['info']): string {
  const name = info?.description || [info?.vendor, info?.architecture].filter(Boolean).join(' ');
  return name || 'a graphics adapter';
}

/**
 * Choose where the graphs run. Asking for 'webgpu' also takes a software adapter; when there is none at all the answer
 * is wasm, and the reason says so.
 * @param asked wasm threads, instead of as many as suit the machine
 */
export async function chooseBackend(
  preference: Preference,
  environment: Environment,
  asked?: number,
): Promise<Backend> {
  const threads = wasmThreads(environment, asked);
  const onProcessor = threads === 1 ? 'Processor, one thread' : `Processor, ${threads} threads`;
  if (preference === 'wasm')
    return { name: 'wasm', reason: `${onProcessor}: chosen in the address of the page.`, threads };
  const probed = await probe(environment, preference === 'webgpu');
  if ('without' in probed) return { name: 'wasm', reason: `${onProcessor}: ${probed.without}.`, threads };
  return { name: 'webgpu', reason: `WebGPU on ${describe(probed.adapter.info)}.`, threads };
}

/** The processor in place of a GPU that failed. @param why beginning of the reason, a main clause */
export function fallBackToWasm(backend: Backend, why: string): Backend {
  return { ...backend, name: 'wasm', reason: `${why}, so the processor is used.` };
}
