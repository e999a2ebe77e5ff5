import { parseManifest } from '../parse-manifest';
import { type Backend, chooseBackend, fallBackToWasm, type Preference, environment } from './backend';
import { AppError } from '../../common/error';
import { goldenError, readGolden } from './golden';
import { fetchWithTimeout } from '../../common/fetch';
import { folderFetch, type ModelFolder } from './download';
import { fetchLatest } from './network-first';
import { type Manifest } from '../manifest';
import { downloadFiles, type DownloadPart, downloadParts } from './assets';
import { unitGains } from '../sample/blend';
import { BranchSampler } from '../sample/branch-sampler';
import { decodeClip } from '../sample/decoder';
import { Pipeline } from '../sample/pipeline';
import { secondsNow } from '../sample/playhead';
import type { Provider } from './runtime';
import { type ModelSession, openSession } from './session';
import { responseCache } from './cache';

export interface LoadOptions {
  /** Absolute address of manifest.json; the graphs' paths are relative to it. */
  readonly manifestUrl: string;
  /** The model's files, where the visitor chose them; by default they are fetched from beside the manifest. */
  readonly folder?: ModelFolder | undefined;
  readonly backend: Preference;
  /** Number of wasm threads; by default as many as suit the machine. */
  readonly threads?: number | undefined;
  /** Why it is the processor although another backend was asked for first: a main clause. */
  readonly processorBecause?: string | undefined;
}

/** What happens while a model is being loaded. */
export type Status =
  /** Comes first; graphs and runtime are downloaded after the promise that it may get as an answer. */
  | { readonly kind: 'manifest'; readonly manifest: Manifest }
  | { readonly kind: 'download'; readonly parts: readonly DownloadPart[] }
  | { readonly kind: 'open' | 'check' | 'warm-up' }
  /** On WebGPU: metres between its golden sampling and Python's. */
  | { readonly kind: 'checked'; readonly error: number }
  | {
      readonly kind: 'notice';
      readonly code: 'not-cached' | 'gpu-lost';
      readonly message: string;
      readonly hint: string;
    }
  | { readonly kind: 'ready'; readonly backend: Backend };

export interface LoadedModel {
  readonly pipeline: Pipeline;
  readonly backend: Backend;
}

/** Metres. Single precision on another device differs by rounding, far below this; a broken driver by far more. */
const GOLDEN_TOLERANCE = 1e-3;

/** @param url where it is from. @throws {AppError} */
function readManifest(bytes: Uint8Array, url: string): Manifest {
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    throw new AppError(
      'manifest-invalid',
      `The model's manifest ${url} is not JSON.`,
      'Export the model again and take its whole folder.',
      { cause: error },
    );
  }
  return parseManifest(json);
}

/** Runs each graph once on zeros: the first run compiles it, which would delay the first generation. */
async function warmUp(manifest: Manifest, session: ModelSession): Promise<void> {
  const { latent, audio, skeleton } = manifest;
  const frames = latent.block * latent.stride;
  const leader = new Float32Array(frames * skeleton.joints.length * 3);
  const music = new Float32Array(frames * audio.features);
  const condition = { leader, music, musicValid: new Float32Array(frames), role: 0 };
  const alone = { silent: false, unconditional: false, mean: false };
  const once: Manifest = { ...manifest, diffusion: { ...manifest.diffusion, steps: 1 } };
  const { conditional: latents } = await new BranchSampler(once, session).branches(condition, 0, alone);
  const gains = unitGains(latent);
  await decodeClip(session, manifest, { latents, leader, gains, role: 0 });
}

/** The browser did not keep the files of a model. */
function notCached(reason: unknown): Status {
  const name = reason instanceof Error ? reason.name : String(reason);
  const remedy = name === 'QuotaExceededError' ? 'free some storage' : 'let this site keep data';
  return {
    kind: 'notice',
    code: 'not-cached',
    message: `The browser could not keep the model (${name}).`,
    hint: `It works, but is downloaded again at the next visit; ${remedy} to avoid that.`,
  };
}

/**
 * Opens a session on WebGPU and checks it.
 * @param check says in a main clause what is wrong with a session; null where nothing is
 * @returns the session, or in a main clause why WebGPU cannot be used here
 * @throws {AppError} what has nothing to do with WebGPU
 */
async function openOnGpu(
  open: () => Promise<ModelSession>,
  check: (session: ModelSession) => Promise<string | null>,
): Promise<ModelSession | string> {
  let session: ModelSession | undefined;
  let failure: string | null;
  try {
    session = await open();
    failure = await check(session);
    if (failure === null) return session;
  } catch (error) {
    const isLost = error instanceof AppError && error.code === 'gpu-lost';
    if (error instanceof AppError && !isLost) throw error;
    // What onnxruntime throws from WebAssembly is a bare number, which tells nobody anything.
    const why = error instanceof Error ? ` (${error.message})` : '';
    failure = `The graphs do not run on WebGPU here${why}`;
    // Releasing what was on a lost GPU might never end.
    if (isLost) return failure;
  }
  await session?.release();
  return failure;
}

/**
 * Fetches, verifies, opens and tests a model.
 * @param scope the worker's global scope
 * @param onStatus may delay downloading and opening: what it returns for the status `manifest` or `open` is waited for
 * @throws {AppError}
 */
export async function loadModel(
  { manifestUrl, folder, backend: preference, threads, processorBecause }: LoadOptions,
  scope: typeof globalThis,
  onStatus: (status: Status) => unknown,
): Promise<LoadedModel> {
  const get = folder ? folderFetch(folder, manifestUrl) : fetchWithTimeout(fetch);
  const cache = folder ? undefined : responseCache(scope);
  const manifest = await fetchLatest(manifestUrl, get, (bytes) => readManifest(bytes, manifestUrl), cache);
  const mayDownload = onStatus({ kind: 'manifest', manifest });
  const place = { manifestUrl, folder, scope };
  let backend = await chooseBackend(preference, environment(scope), threads);
  if (processorBecause !== undefined) backend = fallBackToWasm(backend, processorBecause);
  await mayDownload;

  const open = async (provider: Provider): Promise<ModelSession> => {
    const { graphs, runtime } = await downloadParts(manifest, provider, {
      ...place,
      onProgress: (parts) => {
        onStatus({ kind: 'download', parts });
      },
      onCacheFailure: (reason) => {
        onStatus(notCached(reason));
      },
    });
    await onStatus({ kind: 'open' });
    return openSession(manifest, graphs, provider, backend.threads, runtime);
  };
  const goldenProblem = async (session: ModelSession): Promise<string | null> => {
    onStatus({ kind: 'check' });
    const [golden] = await downloadFiles(manifest, [manifest.golden], place);
    const error = await goldenError(manifest, session, readGolden(golden!));
    onStatus({ kind: 'checked', error });
    // Not a number is a failure too.
    if (error <= GOLDEN_TOLERANCE) return null;
    return `The GPU's numbers differed from the reference by ${error.toPrecision(2)} m`;
  };

  let session: ModelSession | undefined;
  if (backend.name === 'webgpu') {
    const opened = await openOnGpu(() => open('webgpu'), goldenProblem);
    if (typeof opened === 'string') backend = fallBackToWasm(backend, opened);
    else session = opened;
  }
  session ??= await open('wasm');
  // The golden check has warmed a GPU up.
  if (backend.name === 'wasm') {
    onStatus({ kind: 'warm-up' });
    await warmUp(manifest, session);
  }
  onStatus({ kind: 'ready', backend });
  return { pipeline: new Pipeline(manifest, session, secondsNow), backend };
}
