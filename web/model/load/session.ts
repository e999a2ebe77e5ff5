/** The three graphs of a model under onnxruntime: one execution provider, one run at a time. */
import type * as ort from 'onnxruntime-web/wasm';
import { AppError } from '../../common/error';
import { tensorsOf } from '../graph-shapes';
import { GRAPHS, type GraphName, type Manifest } from '../manifest';
import { loadRuntime, type Provider, type Runtime } from './runtime';
import type {
  ConditionInput,
  ConditionRunner,
  DecodeInput,
  DecodeRunner,
  HeldLatents,
  StepInput,
  StepRunner,
} from '../sample/graphs';

/** The three graphs of a model, ready to run. Calls may overlap; they are run one after the other. */
export interface ModelSession {
  readonly condition: ConditionRunner;
  readonly step: StepRunner;
  readonly decode: DecodeRunner;
  /** Frees the graphs; running calls are finished first. */
  release(): Promise<void>;
}

type Tensors = Record<string, ort.Tensor>;
type Arrays = Record<string, Float32Array>;

// Overlapping runs on a WebGPU device hang for ever without an error, so all sessions share one queue.
let lastJob: Promise<unknown> = Promise.resolve();

function enqueue<T>(job: () => Promise<T>): Promise<T> {
  const result = lastJob.then(job);
  lastJob = result.catch(() => undefined);
  return result;
}

/** @param wanted names of the inputs and outputs that it needs */
async function open(
  runtime: Runtime,
  name: GraphName,
  wanted: { readonly inputs: readonly string[]; readonly outputs: readonly string[] },
  bytes: Uint8Array,
  provider: Provider,
): Promise<ort.InferenceSession> {
  const session = await runtime.InferenceSession.create(bytes, {
    // Exactly one: with two, onnxruntime would fall back to the second without a notice.
    executionProviders: [provider],
    graphOptimizationLevel: 'all',
    // Errors only: shape arithmetic stays on the processor, of which a graph on WebGPU would warn.
    logSeverityLevel: 3,
    // Latents stay on the graphics card from step to step; reading them in between would wait for it each time.
    ...(provider === 'webgpu' && name === 'step' && { preferredOutputLocation: 'gpu-buffer' as const }),
  });
  const missing = [
    ...wanted.inputs.filter((input) => !session.inputNames.includes(input)),
    ...wanted.outputs.filter((output) => !session.outputNames.includes(output)),
  ];
  if (missing.length === 0) return session;
  await session.release();
  throw new AppError(
    'model-mismatch',
    `The graph "${name}" has no input or output named ${missing.map((m) => `"${m}"`).join(', ')}.`,
    'Export the model again with this version of the project, or use the model it ships with.',
  );
}

/** Tells the runs on a GPU when that is lost: they would never end, or end without the reason. */
class GpuLoss {
  readonly #failures = new Set<(error: AppError) => void>();
  #error: AppError | null = null;

  /** @param device of the runtime, or its promise; there when a graph is open */
  constructor(device: GPUDevice | Promise<GPUDevice>) {
    void Promise.resolve(device)
      .then(({ lost }) => lost)
      .then(({ message, reason }) => {
        this.#error = new AppError(
          'gpu-lost',
          `The graphics card stopped working for this page (${message || reason}).`,
          'Reload the page to try it again, or choose the processor.',
        );
        for (const fail of this.#failures) fail(this.#error);
      });
  }

  /** The result of a run. @throws {AppError} `gpu-lost` */
  async unlessLost<T>(run: () => Promise<T>): Promise<T> {
    let fail: (error: AppError) => void = () => undefined;
    try {
      return await new Promise<T>((resolve, reject) => {
        fail = reject;
        this.#failures.add(fail);
        if (this.#error) reject(this.#error);
        // A run may fail a moment before its GPU is known to be lost.
        else run().then(resolve, (error: Error) => setTimeout(() => reject(error), LOSS_MS));
      });
    } finally {
      this.#failures.delete(fail);
    }
  }
}

/** How long after a failed run the loss of the GPU is waited for, which would explain it, milliseconds. */
const LOSS_MS = 500;

/** Reads all results. Reading is what waits for a GPU; a result is only there once it has been read. */
async function readAll(results: Tensors): Promise<Arrays> {
  const arrays: Arrays = {};
  for (const [name, value] of Object.entries(results)) {
    arrays[name] = (await value.getData()) as Float32Array;
    value.dispose();
  }
  return arrays;
}

function output<T>(results: Readonly<Record<string, T>>, name: string): T {
  const result = results[name];
  if (result === undefined) throw new Error(`onnxruntime returned no "${name}"`);
  return result;
}

/** A result that stays where the runtime has it. */
class HeldTensor implements HeldLatents {
  /** @param inTurn runs a job between the runs of graphs */
  constructor(
    readonly tensor: ort.Tensor,
    readonly inTurn: <T>(job: () => Promise<T>) => Promise<T>,
  ) {}

  read(): Promise<Float32Array> {
    return this.inTurn(async () => (await this.tensor.getData()) as Float32Array);
  }

  free(): void {
    this.tensor.dispose();
  }
}

/**
 * Open the three graphs on one execution provider.
 * @param graphs the ONNX files
 * @param threads of the wasm runtime; the first session of a worker decides for all
 * @param wasm the runtime's WebAssembly; without it onnxruntime fetches its own
 * @throws {AppError} `model-mismatch` when a graph has not the inputs and outputs this page feeds and reads; its runs
 * throw `gpu-lost`
 */
export async function openSession(
  manifest: Manifest,
  graphs: Readonly<Record<GraphName, Uint8Array>>,
  provider: Provider,
  threads: number,
  wasm?: Uint8Array<ArrayBuffer>,
): Promise<ModelSession> {
  const runtime = await loadRuntime(provider, threads, wasm);
  const sessions: Partial<Record<GraphName, ort.InferenceSession>> = {};
  const release = async (): Promise<void> => {
    for (const session of Object.values(sessions)) await session.release();
  };
  try {
    for (const name of GRAPHS) {
      const { inputs, outputs } = tensorsOf(manifest)[name];
      const wanted = { inputs: Object.keys(inputs), outputs: Object.keys(outputs) };
      sessions[name] = await enqueue(() => open(runtime, name, wanted, graphs[name], provider));
    }
  } catch (error) {
    await enqueue(release);
    throw error;
  }
  // Compiled by now: its bytes need not stay in memory.
  delete runtime.env.wasm.wasmBinary;
  const { condition, step, decode } = sessions as Record<GraphName, ort.InferenceSession>;
  const loss = provider === 'webgpu' ? new GpuLoss(runtime.env.webgpu.device) : null;
  const inTurn = <T>(job: () => Promise<T>): Promise<T> =>
    enqueue(() => (loss ? loss.unlessLost(job) : job()));
  const runNext = (graph: ort.InferenceSession, feeds: () => Tensors): Promise<Arrays> =>
    inTurn(async () => readAll(await graph.run(feeds())));
  const { latent, audio } = manifest;
  const joints = manifest.skeleton.joints.length;
  const tensor = (data: Float32Array | readonly number[], dims: readonly number[]): ort.Tensor =>
    new runtime.Tensor('float32', data instanceof Float32Array ? data : Float32Array.from(data), dims);
  const [layers, streams] = [latent.layers.length, latent.streams.length];

  return {
    condition: async ({ leader, music, musicValid, role }: ConditionInput) => {
      const frames = musicValid.length;
      const results = await runNext(condition, () => ({
        leader: tensor(leader, [frames, joints, 3]),
        music: tensor(music, [frames, audio.features]),
        music_valid: tensor(musicValid, [frames]),
        role: tensor([role], [1]),
      }));
      return { memory: output(results, 'memory'), unfamiliarity: output(results, 'unfamiliarity') };
    },
    step: async ({ blocks, x, memory, valid, keep, time, a, b }: StepInput) => {
      const state =
        x instanceof HeldTensor
          ? x.tensor
          : tensor(x as Float32Array, [blocks, latent.block, layers, latent.channels]);
      const results = await inTurn(() =>
        step.run({
          x: state,
          memory: tensor(memory, [blocks, latent.block, latent.memory_width]),
          valid: tensor(valid, [blocks, latent.block]),
          keep: tensor([keep], [1]),
          time: tensor([time], [1]),
          a: tensor([a], [1]),
          b: tensor([b], [1]),
        }),
      );
      return new HeldTensor(output(results, 'next'), inTurn);
    },
    decode: async ({ latents, leader, gains, role }: DecodeInput) => {
      const results = await runNext(decode, () => ({
        latents: tensor(latents, [latents.length / (layers * latent.channels), layers, latent.channels]),
        leader: tensor(leader, [leader.length / (joints * 3), joints, 3]),
        gains: tensor(gains, [streams, layers]),
        role: tensor([role], [1]),
      }));
      return output(results, 'reactor');
    },
    release: () => enqueue(release),
  };
}
