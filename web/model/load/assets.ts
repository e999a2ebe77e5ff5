import processor from 'onnxruntime-web/ort-wasm-simd-threaded.wasm?manifest-entry';
import gpu from 'onnxruntime-web/ort-wasm-simd-threaded.asyncify.wasm?manifest-entry';
import { download } from './download';
import { folderFetch, type ModelFolder } from './folder';
import { GRAPHS, type GraphName, type Manifest, type ManifestFile } from '../manifest';
import type { Provider } from './session';
import { fileStore, type KeptPart } from './cache';

/**
 * The WebAssembly file that each build of onnxruntime would fetch for itself. It is the largest thing that the page
 * loads, so it is fetched, shown and kept as a model is.
 */
const RUNTIME: Readonly<Record<Provider, ManifestFile>> = { wasm: processor, webgpu: gpu };

/** How far one part of what is downloaded has come, in bytes. */
export interface DownloadPart {
  readonly name: KeptPart;
  readonly loaded: number;
  readonly total: number;
  /** Bytes of `loaded` that were kept on this device and not downloaded. */
  readonly kept: number;
}

export interface Parts {
  readonly graphs: Readonly<Record<GraphName, Uint8Array>>;
  /** onnxruntime's WebAssembly. */
  readonly runtime: Uint8Array<ArrayBuffer>;
}

export interface PartsOptions {
  readonly manifestUrl: string;
  /** The model's files, where they come from the visitor; they need no second copy and are not kept. */
  readonly folder?: ModelFolder | undefined;
  readonly scope: typeof globalThis;
  readonly onProgress: (parts: readonly DownloadPart[]) => void;
  /** Called once, when something could not be kept. */
  readonly onUnkept: (reason: unknown) => void;
}

/**
 * The runtime and the graphs for a provider, both at once, from this device where it has them.
 * @throws {AppError} as `download`
 */
export async function downloadParts(
  manifest: Manifest,
  provider: Provider,
  { manifestUrl, folder, scope, onProgress, onUnkept }: PartsOptions,
): Promise<Parts> {
  const here = new Map<KeptPart, DownloadPart>();
  const report = (name: KeptPart) => (loaded: number, total: number, kept: number) => {
    here.set(name, { name, loaded, total, kept });
    const [runtime, model] = [here.get('runtime'), here.get('model')];
    // Both are looked up at the same time; a bar that knew only one of them would jump.
    if (runtime && model) onProgress([runtime, model]);
  };
  let told = false;
  const tellOnce = (reason: unknown): void => {
    if (!told) onUnkept(reason);
    told = true;
  };
  const graphs = GRAPHS.map((name) => manifest.graphs[name].files);
  // A graphics card that fails its check falls back to the processor at each visit: what that needs stays too.
  const [[runtime], model] = await Promise.all([
    download(scope.location.href, [RUNTIME[provider]], {
      fetch,
      store: fileStore(scope, 'runtime', 'onnxruntime'),
      spare: Object.values(RUNTIME).map(({ sha256 }) => sha256),
      onProgress: report('runtime'),
      onUnkept: tellOnce,
    }),
    download(
      manifestUrl,
      graphs.map((files) => files[provider]),
      {
        fetch: folder ? folderFetch(folder, manifestUrl) : fetch,
        store: folder ? undefined : fileStore(scope, 'model', manifest.id),
        spare: graphs.flatMap((files) => Object.values(files).map(({ sha256 }) => sha256)),
        onProgress: report('model'),
        onUnkept: tellOnce,
      },
    ),
  ]);
  if (runtime === undefined) throw new Error('The download gave no runtime.');
  return {
    graphs: Object.fromEntries(GRAPHS.map((name, i) => [name, model[i]])) as Record<GraphName, Uint8Array>,
    runtime,
  };
}
