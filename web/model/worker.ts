/** The worker that runs the model with onnxruntime. */
import { serve, type TaskContext } from '../common/serve-tasks';
import type { Backend } from './load/backend';
import { type LoadedModel, loadModel, type LoadOptions, type Status } from './load/load';
import type { Manifest } from './manifest';
import type { Progress } from './progress';
import type { CoarseRequest, DanceSettings, SeedsRequest, Source } from './sample/inputs';
import type { Pipeline } from './sample/pipeline';
import type { Playhead } from './sample/playhead';
import type { GeneratedMotion, GenerateResult, Preview } from './sample/results';

export interface Loaded {
  readonly manifest: Manifest;
  readonly backend: Backend;
}

/** What is reported while a generation runs. */
type GenerateReport =
  | { readonly kind: 'progress'; readonly progress: Progress }
  | { readonly kind: 'preview'; readonly preview: Preview };

/** What is danced to: sent once, and null in the calls after it that have the same. */
type SourceCall = { readonly source: Source | null };

let model: LoadedModel | undefined;
let lastSource: Source | undefined;

function pipeline(): Pipeline {
  if (model === undefined) throw new Error('the model was asked before it was loaded');
  return model.pipeline;
}

function sourceOf({ source }: SourceCall): Source {
  lastSource = source ?? lastSource;
  if (lastSource === undefined) throw new Error('the first call has to say what is danced to');
  return lastSource;
}

const tasks = {
  async load(options: LoadOptions, { report }: TaskContext<Status>): Promise<Loaded> {
    model = await loadModel(options, globalThis, report);
    return { manifest: model.pipeline.manifest, backend: model.backend };
  },

  generate(
    { settings, playhead, ...call }: SourceCall & { settings: DanceSettings; playhead: Playhead | undefined },
    { signal, report }: TaskContext<GenerateReport>,
  ): Promise<GenerateResult> {
    return pipeline().generate(
      { ...sourceOf(call), ...settings },
      {
        signal,
        playhead,
        onProgress: (progress) => void report({ kind: 'progress', progress }),
        onPreview: (preview) => report({ kind: 'preview', preview }),
      },
    );
  },

  differingSeeds(
    {
      settings,
      seeds,
      ...call
    }: SourceCall & { settings: DanceSettings; seeds: Omit<SeedsRequest, 'request'> },
    { signal, report }: TaskContext<number>,
  ): Promise<number[]> {
    const request = { ...sourceOf(call), ...settings };
    return pipeline().differingSeeds(
      { request, ...seeds },
      { signal, onProgress: (fraction) => void report(fraction) },
    );
  },

  coarse(request: CoarseRequest, { signal }: TaskContext<never>): Promise<GeneratedMotion> {
    return pipeline().coarse(request, { signal });
  },
};
export type ModelTasks = typeof tasks;

// onnxruntime starts its threads from the script that it is bundled into, which may be this one.
if (!self.name.startsWith('em-pthread')) serve(tasks);
