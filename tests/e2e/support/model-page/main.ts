/** The model client without the app around it, for browser tests to call. */
import { parseManifest } from '../../../../web/model/parse-manifest';
import { goldenError, readGolden } from '../../../../web/model/load/golden';
import { GRAPHS, type GraphName } from '../../../../web/model/manifest';
import type { Provider } from '../../../../web/model/load/runtime';
import { openSession } from '../../../../web/model/load/session';
import { readNpz } from '../../../../web/model/load/npz';
import { solve } from '../../../../web/motion/fit/ik';
import {
  createGenerator,
  type Generator,
  type GenerateRequest,
  type GeneratorOptions,
  type ReloadFailure,
  type Status,
} from '../../../../web/model/client';

/** A failure or cancellation as data, for the test's process. */
export interface ExplainedError {
  readonly name: string;
  readonly code: string | undefined;
  readonly message: string;
  readonly hint: string | undefined;
}

export interface Answer {
  readonly stages: readonly string[];
  readonly positions?: readonly number[];
  readonly error?: ExplainedError;
}

function tell(error: unknown): ExplainedError {
  const { name, code, message, hint } = error as Partial<ExplainedError>;
  return {
    name: name ?? 'none',
    code: typeof code === 'string' ? code : undefined,
    message: message ?? '',
    hint,
  };
}

async function bytes(url: string): Promise<Uint8Array> {
  return new Uint8Array(await (await fetch(url)).arrayBuffer());
}

/** Progress that the worker has sent: the page answers each such call through a port, whoever listens. */
let answered = 0;
// eslint-disable-next-line @typescript-eslint/unbound-method -- called with the port it was called on
const { postMessage } = MessagePort.prototype;
MessagePort.prototype.postMessage = function (this: MessagePort, ...values: [unknown]) {
  answered += 1;
  postMessage.apply(this, values);
};

let generator: Generator | undefined;
let golden: ReturnType<typeof readNpz> | undefined;

export const page = {
  statuses: [] as (Status | ReloadFailure)[],
  /** Steps that the generation under way has reported. */
  steps: 0,

  /** How often the worker sends progress within a second: that it stops is seen from nothing coming for a time. */
  async progressInASecond(): Promise<number> {
    // What was sent before may still wait for a page that was busy.
    await new Promise((resolve) => setTimeout(resolve, 500));
    const before = answered;
    await new Promise((resolve) => setTimeout(resolve, 1000));
    return answered - before;
  },

  /** Load a model; returns where it computes, or how it failed. */
  async open(
    options: GeneratorOptions,
  ): Promise<{ backend: Generator['backend'] } | { error: ExplainedError }> {
    page.statuses = [];
    try {
      generator = await createGenerator({ ...options, onStatus: (status) => page.statuses.push(status) });
      return { backend: generator.backend };
    } catch (error) {
      return { error: tell(error) };
    }
  },

  async readGolden(url: string): Promise<void> {
    golden = readNpz(await bytes(url));
  },

  /**
   * The golden sampling of a model folder on one execution provider, in the page itself: metres from Python's joints
   * where they differ most, and how much work the page gave to the GPU.
   * @param filesOf the provider whose files to take: wasm's compute products in 8 bits, WebGPU's in single precision
   */
  async golden(
    folder: string,
    provider: Provider,
    filesOf: Provider = provider,
  ): Promise<{ error: number; submissions: number }> {
    let submissions = 0;
    const gpu = globalThis.GPUQueue?.prototype as GPUQueue | undefined;
    if (gpu !== undefined) {
      // eslint-disable-next-line @typescript-eslint/unbound-method -- called with the queue it was called on
      const { submit } = gpu;
      gpu.submit = function (this: GPUQueue, buffers) {
        submissions += 1;
        submit.call(this, buffers);
      };
    }
    const manifest = parseManifest(await (await fetch(`${folder}manifest.json`)).json());
    const files = await Promise.all(
      GRAPHS.map(
        async (name) => [name, await bytes(folder + manifest.graphs[name].files[filesOf].path)] as const,
      ),
    );
    const graphs = Object.fromEntries(files) as Record<GraphName, Uint8Array>;
    const session = await openSession(manifest, graphs, provider, 1);
    const error = await goldenError(manifest, session, readGolden(await bytes(`${folder}golden.npz`)));
    await session.release();
    return { error, submissions };
  },

  /** A request made of the first frames of the golden leader and its song. */
  request(frames: number): GenerateRequest {
    const array = (name: string): Float32Array => Float32Array.from(golden?.get(name)?.data ?? []);
    const columns = (golden?.get('music')?.shape[1] ?? 0) * frames;
    const leader = { fps: 30, frames, positions: array('leader').slice(0, frames * 66) };
    return {
      leader,
      fitted: solve(leader),
      music: { features: array('music').slice(0, columns), frames },
      guidance: Float32Array.from([...array('coarse')].flatMap((weight, i) => [weight, array('fine')[i]!])),
      musicGuidance: array('music_guidance')[0] ?? NaN,
      variety: 1,
      seed: 1,
    };
  },

  /** Generate; `abortAt` cancels after that many reported steps. */
  async generate(frames: number, abortAt = Infinity): Promise<Answer> {
    if (generator === undefined) throw new Error('open comes first');
    const controller = new AbortController();
    const stages: string[] = [];
    page.steps = 0;
    try {
      const { motion } = await generator.generate(page.request(frames), {
        signal: controller.signal,
        onProgress: ({ stage }) => {
          stages.push(stage);
          if (stage !== 'step') return;
          page.steps += 1;
          if (page.steps >= abortAt) controller.abort();
        },
      });
      return { stages, positions: Array.from(motion.positions) };
    } catch (error) {
      return { stages, error: tell(error) };
    }
  },
};

Object.assign(globalThis, { model: page });

declare global {
  var model: typeof page;
}
