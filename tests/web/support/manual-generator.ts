import type {
  GenerateOptions,
  GenerateRequest,
  GenerateResult,
  Generator,
  SeedsOptions,
  SeedsRequest,
} from '../../../web/model/client';
import { small } from './small-manifest';
import { still } from './made-state';

/** A generator whose answers the test gives. */
export class ManualGenerator {
  readonly calls: {
    request: GenerateRequest;
    options: GenerateOptions;
    answer: (result: GenerateResult) => void;
    fail: (error: Error) => void;
  }[] = [];
  readonly seedCalls: {
    request: SeedsRequest;
    options: SeedsOptions;
    answer: (seeds: number[]) => void;
  }[] = [];
  readonly generator = {
    manifest: small,
    backend: { name: 'wasm', reason: '', threads: 1 },
    generate: (request: GenerateRequest, options: GenerateOptions = {}) =>
      new Promise<GenerateResult>((answer, fail) => {
        this.calls.push({ request, options, answer, fail });
        options.signal?.addEventListener('abort', () => {
          fail(options.signal?.reason as Error);
        });
      }),
    differingSeeds: (request: SeedsRequest, options: SeedsOptions = {}) =>
      new Promise<number[]>((answer, fail) => {
        this.seedCalls.push({ request, options, answer });
        options.signal?.addEventListener('abort', () => {
          fail(options.signal?.reason as Error);
        });
      }),
    coarse: () => Promise.resolve({ motion: still(60), locked: still(60) }),
    dispose: () => undefined,
  } satisfies Generator;
}

/** A result that it may answer with. */
export const result = (frames = 60): GenerateResult => ({
  motion: still(frames),
  locked: still(frames),
  latents: new Float32Array(frames),
  unfamiliarity: 1,
  seconds: { steps: 2.5, decode: 0.25, solve: 0.25 },
});
