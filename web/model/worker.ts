/** The worker that runs the model with onnxruntime. */
import { serve, type TaskContext } from '../common/run-in-worker';
import type { SolvedMotion } from '../motion/skeleton/clip';
import type { Backend } from './load/backend';
import { type LoadedModel, loadModel, type LoadOptions, type Status } from './load/load';
import type { Manifest } from './manifest';
import type { Progress } from './progress';
import type { CoarseRequest, GenerateRequest, SeedsRequest } from './sample/inputs';
import type { Pipeline } from './sample/pipeline';
import type { GenerateResult, Preview } from './sample/results';

export interface Loaded {
  readonly manifest: Manifest;
  readonly backend: Backend;
}

/** What is reported while a generation runs. */
type GenerateReport =
  | { readonly kind: 'progress'; readonly progress: Progress }
  | { readonly kind: 'preview'; readonly preview: Preview };

let model: LoadedModel | undefined;

function pipeline(): Pipeline {
  if (model === undefined) throw new Error('the model was asked before it was loaded');
  return model.pipeline;
}

const tasks = {
  async load(options: LoadOptions, { report }: TaskContext<Status>): Promise<Loaded> {
    model = await loadModel(options, globalThis, report);
    return { manifest: model.pipeline.manifest, backend: model.backend };
  },

  /** `at`: motion frame on view, undefined for no previews. */
  generate(
    { request, at }: { request: GenerateRequest; at: number | undefined },
    { signal, report }: TaskContext<GenerateReport>,
  ): Promise<GenerateResult> {
    return pipeline().generate(request, {
      signal,
      at,
      onProgress: (progress) => report({ kind: 'progress', progress }),
      onPreview: (preview) => report({ kind: 'preview', preview }),
    });
  },

  differingSeeds(request: SeedsRequest, { signal, report }: TaskContext<number>): Promise<number[]> {
    return pipeline().differingSeeds(request, { signal, onProgress: report });
  },

  coarse(request: CoarseRequest, { signal }: TaskContext<never>): Promise<SolvedMotion> {
    return pipeline().coarse(request, { signal });
  },
};
export type ModelTasks = typeof tasks;

// onnxruntime starts its threads from the script that it is bundled into, which may be this one.
if (!self.name.startsWith('em-pthread')) serve(tasks);
