import processor from 'onnxruntime-web/ort-wasm-simd-threaded.wasm?manifest-entry';
import gpu from 'onnxruntime-web/ort-wasm-simd-threaded.asyncify.wasm?manifest-entry';
import { fetchWithTimeout } from '../../common/fetch';
import { download, type DownloadOptions, folderFetch, type ModelFolder } from './download';
import { GRAPHS, type GraphName, type Manifest, type ManifestFile } from '../manifest';
import type { Provider } from './runtime';
import { fileStore, type CachedPart } from './cache';

/**
 * The WebAssembly file that each build of onnxruntime would fetch for itself. It is the largest thing that the page
 * loads, so it is fetched, reported and cached as a model is.
 */
const RUNTIME: Readonly<Record<Provider, ManifestFile>> = { wasm: processor, webgpu: gpu };

/**
 * Gets onnxruntime's WebAssembly, from the cache where it is there.
 * @param scope the worker's global scope
 * @throws {AppError} as `download`
 */
export async function downloadRuntime(
  provider: Provider,
  scope: typeof globalThis,
  options: Pick<DownloadOptions, 'onProgress' | 'onCacheFailure'> = {},
): Promise<Uint8Array<ArrayBuffer>> {
  const [runtime] = await download(scope.location.href, [RUNTIME[provider]], {
    fetch: fetchWithTimeout(fetch),
    store: fileStore(scope, 'runtime', 'onnxruntime'),
    // A GPU that fails its check falls back to the processor at each visit, so files of both providers stay cached.
    alsoKeep: Object.values(RUNTIME).map(({ sha256 }) => sha256),
    ...options,
  });
  if (runtime === undefined) throw new Error('The download gave no runtime.');
  return runtime;
}

/** Progress of one part of the download, bytes. */
export interface DownloadPart {
  readonly name: CachedPart;
  readonly loaded: number;
  readonly total: number;
  /** Bytes of `loaded` that came from the cache. */
  readonly cached: number;
}

interface Parts {
  readonly graphs: Readonly<Record<GraphName, Uint8Array>>;
  /** onnxruntime's WebAssembly. */
  readonly runtime: Uint8Array<ArrayBuffer>;
}

interface Place {
  readonly manifestUrl: string;
  /** The model's files, where the visitor chose them; they are not cached. */
  readonly folder?: ModelFolder | undefined;
  readonly scope: typeof globalThis;
}

/** All files that a manifest lists. */
export function filesOf({ graphs, golden }: Pick<Manifest, 'graphs' | 'golden'>): ManifestFile[] {
  return [...GRAPHS.flatMap((name) => Object.values(graphs[name].files)), golden];
}

/**
 * Gets some files of a model, from the cache where it has them.
 * @returns the files' bytes, in order
 * @throws {AppError} as `download`
 */
export function downloadFiles(
  manifest: Manifest,
  files: readonly ManifestFile[],
  { manifestUrl, folder, scope }: Place,
  options: Pick<DownloadOptions, 'onProgress' | 'onCacheFailure' | 'after'> = {},
): Promise<Uint8Array<ArrayBuffer>[]> {
  return download(manifestUrl, files, {
    fetch: folder ? folderFetch(folder, manifestUrl) : fetchWithTimeout(fetch),
    store: folder ? undefined : fileStore(scope, 'model', manifest.id),
    alsoKeep: filesOf(manifest).map(({ sha256 }) => sha256),
    ...options,
  });
}

interface PartsOptions extends Place {
  readonly onProgress: (parts: readonly DownloadPart[]) => void;
  /** Called once, when a file could not be cached. */
  readonly onCacheFailure: (reason: unknown) => void;
}

/**
 * Gets the runtime and then the graphs for a provider, from the cache where it has them.
 * @throws {AppError} as `download`
 */
export async function downloadParts(
  manifest: Manifest,
  provider: Provider,
  { onProgress, onCacheFailure, ...place }: PartsOptions,
): Promise<Parts> {
  const progress = new Map<CachedPart, DownloadPart>();
  const report = (name: CachedPart) => (loaded: number, total: number, cached: number) => {
    progress.set(name, { name, loaded, total, cached });
    const [runtime, model] = [progress.get('runtime'), progress.get('model')];
    // Both are looked up at the start; a bar that knew only one of them would jump.
    if (runtime && model) onProgress([runtime, model]);
  };
  let reported = false;
  const reportOnce = (reason: unknown): void => {
    if (!reported) onCacheFailure(reason);
    reported = true;
  };
  const graphs = GRAPHS.map((name) => manifest.graphs[name].files[provider]);
  const downloading = downloadRuntime(provider, place.scope, {
    onProgress: report('runtime'),
    onCacheFailure: reportOnce,
  });
  // Half of both would be lost with the connection; what is whole stays.
  const [runtime, model] = await Promise.all([
    downloading,
    downloadFiles(manifest, graphs, place, {
      onProgress: report('model'),
      onCacheFailure: reportOnce,
      after: downloading,
    }),
  ]);
  return {
    graphs: Object.fromEntries(GRAPHS.map((name, i) => [name, model[i]])) as Record<GraphName, Uint8Array>,
    runtime,
  };
}
