/** The worker that runs the model with onnxruntime. */
import { serve, type TaskContext } from '../common/run-in-worker';
import type { SolvedMotion } from '../motion/skeleton/clip';
import type { Backend } from './load/backend';
import { type LoadedModel, loadModel, type LoadOptions, type Status } from './load/load';
import type { Manifest } from './manifest';
import type { Progress } from './progress';
import type { CoarseRequest, DanceSettings, Source } from './sample/inputs';
import type { Pipeline } from './sample/pipeline';
import type { Playhead } from './sample/playhead';
import type { GenerateResult, Preview } from './sample/results';

export interface Loaded {
  readonly manifest: Manifest;
  readonly backend: Backend;
}

/** What is reported while a generation runs. */
type GenerateReport =
  | { readonly kind: 'progress'; readonly progress: Progress }
  | { readonly kind: 'preview'; readonly preview: Preview };

/** What is generated: what is danced to is sent once, and left out of the calls after it that have the same. */
export interface GenerateCall {
  readonly source: Source | null;
  readonly settings: DanceSettings;
  /** Where the dance is on view; undefined for no preview. */
  readonly playhead: Playhead | undefined;
}

let model: LoadedModel | undefined;
let lastSource: Source | undefined;

function pipeline(): Pipeline {
  if (model === undefined) throw new Error('the model was asked before it was loaded');
  return model.pipeline;
}

const tasks = {
  async load(options: LoadOptions, { report }: TaskContext<Status>): Promise<Loaded> {
    model = await loadModel(options, globalThis, (status) => void report(status));
    return { manifest: model.pipeline.manifest, backend: model.backend };
  },

  generate(
    { source, settings, playhead }: GenerateCall,
    { signal, report }: TaskContext<GenerateReport>,
  ): Promise<GenerateResult> {
    lastSource = source ?? lastSource;
    if (!lastSource) throw new Error('the first call has to say what is danced to');
    return pipeline().generate(
      { ...lastSource, ...settings },
      {
        signal,
        playhead,
        onProgress: (progress) => void report({ kind: 'progress', progress }),
        onPreview: (preview) => report({ kind: 'preview', preview }),
      },
    );
  },

  coarse(request: CoarseRequest, { signal }: TaskContext<never>): Promise<SolvedMotion> {
    return pipeline().coarse(request, { signal });
  },
};
export type ModelTasks = typeof tasks;

// onnxruntime starts its threads from the script that it is bundled into, which may be this one.
if (!self.name.startsWith('em-pthread')) serve(tasks);
