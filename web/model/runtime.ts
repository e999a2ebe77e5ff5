/** onnxruntime's WebAssembly: the largest thing that the page loads, so it is fetched, shown and kept as a model is. */
import processor from 'onnxruntime-web/ort-wasm-simd-threaded.wasm?listed';
import gpu from 'onnxruntime-web/ort-wasm-simd-threaded.asyncify.wasm?listed';
import type { ManifestFile } from './manifest';
import type { Provider } from './load/session';

/** The file that each build of onnxruntime would fetch for itself. */
export const RUNTIME: Readonly<Record<Provider, ManifestFile>> = { wasm: processor, webgpu: gpu };
