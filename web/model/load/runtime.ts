/** onnxruntime, and which of its builds is loaded. */
import type * as ort from 'onnxruntime-web/wasm';
import { inTime } from './in-time';
import { loadPart } from '../../common/page-part';

export type Provider = 'webgpu' | 'wasm';
export type Runtime = typeof ort;

/** Longest time for the runtime's script to come, and for its threads to start, milliseconds. */
const START_MS = 60_000;

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
  const runtime = await loadPart(() =>
    inTime(provider === 'wasm' ? import('onnxruntime-web/wasm') : import('onnxruntime-web/webgpu'), START_MS),
  );
  // Read once, when the first graph is opened.
  runtime.env.wasm.initTimeout = START_MS;
  runtime.env.wasm.numThreads = threads;
  if (wasm) runtime.env.wasm.wasmBinary = wasm.buffer;
  runtime.env.logLevel = 'error';
  return runtime;
}
