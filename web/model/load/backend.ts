import type { Provider } from './session';

export type Preference = 'auto' | Provider;

/** Where the graphs run, and why, in words for the page. */
export interface Backend {
  readonly name: Provider;
  readonly reason: string;
  /** Threads of the wasm runtime; with WebGPU they only run the few operations that stay on the CPU. */
  readonly threads: number;
}

/** What the choice depends on; in the page it is the worker's own global scope. */
export interface Surroundings {
  readonly gpu?: Pick<GPU, 'requestAdapter'> | undefined;
  readonly crossOriginIsolated: boolean;
  readonly hardwareConcurrency: number;
}

// More threads gain little on matrices of this size.
const MOST_THREADS = 4;

export function surroundings(scope: typeof globalThis): Surroundings {
  const navigator = scope.navigator as Navigator & { gpu?: GPU };
  return {
    gpu: navigator.gpu,
    crossOriginIsolated: scope.crossOriginIsolated,
    hardwareConcurrency: navigator.hardwareConcurrency,
  };
}

/**
 * Threads share memory, which a page has only when it is cross-origin isolated. One core is left to the page: who has
 * no graphics card for the model has often none for the stage either, which then is drawn by that core. On two cores a
 * dance takes a third longer, and twice as many pictures are drawn meanwhile.
 */
export function wasmThreads(around: Surroundings, asked?: number): number {
  if (!around.crossOriginIsolated) return 1;
  return asked ?? Math.max(1, Math.min(around.hardwareConcurrency - 1, MOST_THREADS));
}

/** The adapter, or the reason why there is none worth using. */
async function probe(
  gpu: Surroundings['gpu'],
  software: boolean,
): Promise<{ adapter: GPUAdapter } | { without: string }> {
  if (gpu === undefined) return { without: 'this browser has no WebGPU' };
  let adapter: GPUAdapter | null;
  try {
    adapter = await gpu.requestAdapter({ powerPreference: 'high-performance' });
  } catch (error) {
    return { without: `WebGPU could not be asked for a graphics adapter (${String(error)})` };
  }
  if (adapter === null) return { without: 'WebGPU found no graphics adapter' };
  if (adapter.info.isFallbackAdapter && !software) {
    return { without: 'WebGPU found only a software adapter, which is slower than the processor itself' };
  }
  return { adapter };
}

/** Names the hardware as far as the browser tells. */
function describe({ vendor, architecture, description }: GPUAdapterInfo): string {
  const name = description || [vendor, architecture].filter((part) => part !== '').join(' ');
  return name === '' ? 'a graphics adapter' : name;
}

/**
 * Choose where the graphs run. Asking for 'webgpu' also takes a software adapter; when there is none at all the answer
 * is wasm, and the reason says so.
 * @param asked wasm threads, instead of as many as suit the machine
 */
export async function chooseBackend(
  preference: Preference,
  around: Surroundings,
  asked?: number,
): Promise<Backend> {
  const threads = wasmThreads(around, asked);
  const onProcessor = threads === 1 ? 'Processor, one thread' : `Processor, ${threads} threads`;
  if (preference === 'wasm') return { name: 'wasm', reason: `${onProcessor}: chosen by hand.`, threads };
  const probed = await probe(around.gpu, preference === 'webgpu');
  if ('without' in probed) return { name: 'wasm', reason: `${onProcessor}: ${probed.without}.`, threads };
  return { name: 'webgpu', reason: `WebGPU on ${describe(probed.adapter.info)}.`, threads };
}

/** WebGPU did not keep what the adapter promised. */
export function demote(backend: Backend, why: string): Backend {
  return { ...backend, name: 'wasm', reason: `${why}, so the processor is used.` };
}
