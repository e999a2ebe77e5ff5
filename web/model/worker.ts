/** The one worker that owns onnxruntime. */
import { expose, transfer } from 'comlink';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { type LoadedModel, loadModel } from './load/load';
import { type ModelWorker, type Outcome, outcome, type WorkerEvent } from './protocol';

let model: LoadedModel | undefined;
let emit: (event: WorkerEvent) => void = () => undefined;
const running = new Map<number, AbortController>();

/** Does a job with the model that can be cancelled by its id. */
async function run<T>(
  id: number,
  job: (loaded: LoadedModel, signal: AbortSignal) => Promise<T>,
): Promise<Outcome<T>> {
  const controller = new AbortController();
  running.set(id, controller);
  const { signal } = controller;
  const result = await outcome(() => {
    if (model === undefined) throw new Error('the model was asked before it was loaded');
    return job(model, signal);
  }, signal);
  running.delete(id);
  return result;
}

/** The memory of motions, which is handed over instead of copied. Locked feet may share what they leave as it was. */
function buffers(...motions: readonly SolvedMotion[]): ArrayBufferLike[] {
  const all = motions.flatMap(({ offsets, root, rotations, positions }) =>
    [offsets, root, rotations, positions].map((array) => array.buffer),
  );
  return [...new Set(all)];
}

const worker: ModelWorker = {
  load(options, onEvent) {
    emit = onEvent;
    return outcome(async () => {
      model = await loadModel(options, globalThis, (status) => {
        emit({ kind: 'status', status });
      });
      return { manifest: model.pipeline.manifest, backend: model.backend };
    });
  },

  async generate(id, request, at) {
    const result = await run(id, ({ pipeline }, signal) =>
      pipeline.generate(request, {
        signal,
        onProgress: (progress) => {
          emit({ kind: 'progress', id, progress });
        },
        at: at ?? undefined,
        onPreview: (preview) => {
          const { motion, locked } = preview;
          emit(transfer({ kind: 'preview', id, preview }, buffers(motion, locked)));
        },
      }),
    );
    if (!result.ok) return result;
    const { motion, locked, latents } = result.value;
    return transfer(result, [...buffers(motion, locked), latents.buffer]);
  },

  async coarse(id, request) {
    const result = await run(id, ({ pipeline }, signal) => pipeline.coarse(request, { signal }));
    return result.ok ? transfer(result, buffers(result.value)) : result;
  },

  cancel(id) {
    running.get(id)?.abort();
  },
};

// onnxruntime starts its threads from the script that it is bundled into, which may be this one.
if (!self.name.startsWith('em-pthread')) expose(worker);
