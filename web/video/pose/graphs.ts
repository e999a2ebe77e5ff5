/** The two networks that see people, detector and landmarks, under onnxruntime. */
import type * as ort from 'onnxruntime-web/wasm';
import * as v from 'valibot';
import { AppError } from '../../common/error';
import { downloadRuntime } from '../../model/load/assets';
import { chooseBackend, environment } from '../../model/load/backend';
import { fileStore, responseCache } from '../../model/load/cache';
import { fetchWithTimeout } from '../../common/fetch';
import { download } from '../../model/load/download';
import { fetchLatest } from '../../model/load/network-first';
import { loadRuntime } from '../../model/load/runtime';
import { DETECTOR_SIDE } from './detector';
import { LANDMARK_SIDE } from './landmarks';

/** The networks, ready to run. Images are RGB, channel by channel. */
export interface PoseGraphs {
  /** @param image 3 x 224 x 224, -1 to 1 */
  detect(image: Float32Array): Promise<Readonly<Record<'boxes' | 'scores', Float32Array>>>;
  /** @param image 3 x 256 x 256, 0 to 1 */
  landmarks(image: Float32Array): Promise<Readonly<Record<'landmarks' | 'world' | 'presence', Float32Array>>>;
}

const file = v.object({ path: v.string(), bytes: v.number(), sha256: v.string() });
const listSchema = v.object({ detector: file, landmarks: file });

/**
 * Downloads the networks or takes them from the cache, and opens them on the processor.
 * @param listUrl absolute address of pose.json, which lists their files
 * @param scope the worker's global scope
 * @param onProgress share of the bytes that are there, 0 to 1
 * @throws {AppError} as `download`
 */
export async function loadPoseGraphs(
  listUrl: string,
  scope: typeof globalThis,
  onProgress: (fraction: number) => void,
): Promise<PoseGraphs> {
  const get = fetchWithTimeout(fetch);
  const { detector, landmarks } = await fetchLatest(listUrl, get, readList, responseCache(scope));
  const [runtimeBytes, [detectorBytes, landmarkBytes], { threads }] = await Promise.all([
    downloadRuntime('wasm', scope),
    download(listUrl, [detector, landmarks], {
      fetch: get,
      store: fileStore(scope, 'model', 'pose'),
      onProgress: (loaded, total) => {
        onProgress(loaded / total);
      },
    }),
    chooseBackend('wasm', environment(scope)),
  ]);
  const runtime = await loadRuntime('wasm', threads, runtimeBytes);
  const open = (graph: Uint8Array | undefined): Promise<ort.InferenceSession> =>
    runtime.InferenceSession.create(graph!, { executionProviders: ['wasm'], graphOptimizationLevel: 'all' });
  const detectorSession = await open(detectorBytes);
  const landmarkSession = await open(landmarkBytes);
  // Compiled by now: its bytes need not stay in memory.
  delete runtime.env.wasm.wasmBinary;
  /** The runs of the runtime follow each other: it can't do two at once. */
  let last: Promise<unknown> = Promise.resolve();
  const run = async (
    session: ort.InferenceSession,
    image: Float32Array,
    side: number,
  ): Promise<Record<string, Float32Array>> => {
    const tensor = new runtime.Tensor('float32', image, [1, 3, side, side]);
    const running = last.then(() => session.run({ image: tensor }));
    last = running.catch(() => undefined);
    const results = await running;
    return Object.fromEntries(
      Object.entries(results).map(([name, value]) => [name, value.data as Float32Array]),
    );
  };
  return {
    detect: async (image) =>
      (await run(detectorSession, image, DETECTOR_SIDE)) as Record<'boxes' | 'scores', Float32Array>,
    landmarks: async (image) =>
      (await run(landmarkSession, image, LANDMARK_SIDE)) as Record<
        'landmarks' | 'world' | 'presence',
        Float32Array
      >,
  };
}

function readList(bytes: Uint8Array): v.InferOutput<typeof listSchema> {
  try {
    return v.parse(listSchema, JSON.parse(new TextDecoder().decode(bytes)));
  } catch (cause) {
    throw new AppError(
      'manifest-invalid',
      'The list of the networks that read videos is damaged.',
      'Reload the page; if this happens again, copy the folder models/pose to the server once more.',
      { cause },
    );
  }
}
