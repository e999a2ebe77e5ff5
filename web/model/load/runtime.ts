/** onnxruntime, and which of its builds is loaded. */
import type * as ort from 'onnxruntime-web/wasm';

export type Provider = 'webgpu' | 'wasm';
export type Runtime = typeof ort;

/**
 * The build of onnxruntime for a provider. The one with WebGPU can compute on the processor too, but takes five times
 * as long there and is twice as large, so each provider has its own and only that one is downloaded.
 * @param threads of the wasm runtime; the first session of a worker decides for all
 * @param wasm the runtime's WebAssembly; without it onnxruntime fetches its own
 */
export async function loadRuntime(
  provider: Provider,
  threads: number,
  wasm?: Uint8Array<ArrayBuffer>,
): Promise<Runtime> {
  const runtime = await (provider === 'wasm'
    ? import('onnxruntime-web/wasm')
    : import('onnxruntime-web/webgpu'));
  // Read once, when the first graph is opened.
  runtime.env.wasm.numThreads = threads;
  if (wasm) runtime.env.wasm.wasmBinary = wasm.buffer;
  runtime.env.logLevel = 'error';
  return runtime;
}
