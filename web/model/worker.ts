/** The one worker that owns onnxruntime. */
import { expose, transfer } from 'comlink';
import { type LoadedModel, loadModel } from './load';
import { type ModelWorker, outcome, type WorkerEvent } from './protocol';

let model: LoadedModel | undefined;
let emit: (event: WorkerEvent) => void = () => undefined;
const running = new Map<number, AbortController>();

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

  async generate(id, request) {
    const controller = new AbortController();
    running.set(id, controller);
    const { signal } = controller;
    const result = await outcome(async () => {
      if (model === undefined) throw new Error('generate was called before load');
      return model.pipeline.generate(request, {
        signal,
        onProgress: (progress) => {
          emit({ kind: 'progress', id, progress });
        },
      });
    }, signal);
    running.delete(id);
    if (!result.ok) return result;
    const { offsets, root, rotations, positions } = result.value.motion;
    return transfer(
      result,
      [offsets, root, rotations, positions].map((array) => array.buffer),
    );
  },

  cancel(id) {
    running.get(id)?.abort();
  },
};

// onnxruntime starts its threads from the script that it is bundled into, which may be this one.
if (!self.name.startsWith('em-pthread')) expose(worker);
