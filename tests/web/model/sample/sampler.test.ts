import { parseManifest } from '../../../../web/model/parse-manifest';
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { noise } from '../../../../web/model/sample/noise';
import type { HeldLatents, StepInput, StepRunner } from '../../../../web/model/sample/graphs';
import { sample, type Sampling } from '../../../../web/model/sample/sampler';
import { ddim } from '../../../../web/model/sample/schedule';
import { small } from '../../support/small-manifest';

const { latent } = small;
const tiny = parseManifest(
  JSON.parse(
    readFileSync(new URL('../../../fixtures/tiny-model/manifest.json', import.meta.url), 'utf8'),
  ) as unknown,
);

/** A sampling in Python in which x0 = x / 2 + time; noise and latents are latents x layers x channels. */
interface Sampled {
  readonly steps: number;
  readonly last_time: number;
  readonly layers: number;
  readonly channels: number;
  readonly noise: readonly number[];
  readonly latents: readonly number[];
}
const width = latent.layers.length * latent.channels;

/** How many latents that a step returned are not freed. */
let unfreed = 0;

function held(values: Float32Array): HeldLatents {
  unfreed += 1;
  return { read: () => Promise.resolve(values), free: () => void (unfreed -= 1) };
}

/** Stands in for the graph: its formula around a prediction. */
function stepping(predict: (x: Float32Array, input: StepInput) => Float32Array): StepRunner {
  return async (input) => {
    const x = input.x instanceof Float32Array ? input.x : await input.x.read();
    const x0 = predict(x, input);
    return held(x.map((value, i) => input.a * value + input.b * x0[i]!));
  };
}

/** Mixes each valid token with its left neighbour inside the block, the memory and the time. */
const mixing = stepping((x, { valid, memory, time }) =>
  x.map((value, i) => {
    const token = Math.floor(i / width);
    if (valid[token] !== 1) return NaN;
    const left = token % latent.block === 0 ? 0 : (x[i - width] ?? 0);
    return 0.5 * value + 0.3 * left + (memory[token * latent.memory_width] ?? 0) + time;
  }),
);

function sampling(latents: number, changes: Partial<Sampling> = {}): Sampling {
  return {
    latent,
    schedule: ddim({ ...small.diffusion, steps: 4 }),
    memory: Float32Array.from({ length: latents * latent.memory_width }, (_, i) => Math.sin(i)),
    keep: 1,
    noise: noise(9, latents, width),
    runStep: mixing,
    blocksPerRun: 100,
    ...changes,
  };
}

/** The same arithmetic frame by frame, without blocks being packed. */
function reference(latents: number): Float32Array {
  let x = noise(9, latents, width);
  const { memory, schedule } = sampling(latents);
  for (const { time, a, b } of schedule) {
    const x0 = x.map((value, i) => {
      const frame = Math.floor(i / width);
      const left = frame % latent.block === 0 ? 0 : (x[i - width] ?? 0);
      return 0.5 * value + 0.3 * left + (memory[frame * latent.memory_width] ?? 0) + time;
    });
    x = x.map((value, i) => a * value + b * x0[i]!);
  }
  return x;
}

describe('sample', () => {
  it('equals the arithmetic without blocks for every length', async () => {
    for (const latents of [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 15, 21, 30, 45, 58, 60]) {
      const result = await sample(sampling(latents));
      const expected = reference(latents);
      expect(result.every((value, i) => Math.abs(value - (expected[i] ?? NaN)) < 1e-5)).toBe(true);
    }
  });

  it('gives the latents that Python does', async () => {
    const golden = JSON.parse(
      readFileSync(new URL('../../../fixtures/sampling.json', import.meta.url), 'utf8'),
    ) as { sampled: Sampled };
    const { steps, last_time, layers, channels, noise, latents } = golden.sampled;
    const length = noise.length / (layers * channels);
    const result = await sample({
      ...sampling(length),
      latent: {
        ...latent,
        layers: Array.from({ length: layers }, (_, i) => `layer ${i}`),
        channels,
        block: 60,
      },
      schedule: ddim({ ...tiny.diffusion, last_time, steps }),
      noise: Float32Array.from(noise),
      runStep: stepping((x, { time }) => x.map((value) => value / 2 + time)),
    });
    expect(result).toHaveLength(latents.length);
    latents.forEach((value, i) => expect(result[i]).toBeCloseTo(value, 5));
  });

  it('takes the only prediction of a single step as it is', async () => {
    const schedule = ddim({ ...small.diffusion, steps: 1 });
    const runStep = stepping((x, { time }) => x.map((value) => value / 2 + time));
    const expected = noise(9, 10, width).map((value) => value / 2 + schedule[0]!.time);
    expect(await sample(sampling(10, { schedule, runStep }))).toEqual(expected);
  });

  it('does not depend on how many blocks go through the graph at once', async () => {
    const whole = await sample(sampling(50));
    for (const blocksPerRun of [1, 2, 3]) {
      expect(await sample(sampling(50, { blocksPerRun }))).toEqual(whole);
    }
  });

  it('leaves the noise that it starts from as it is', async () => {
    const start = noise(9, 20, width);
    await sample(sampling(20, { noise: start }));
    expect(start).toEqual(noise(9, 20, width));
  });

  it('counts the blocks of all steps', async () => {
    const calls: [number, number][] = [];
    await sample(
      sampling(13, {
        blocksPerRun: 2,
        onProgress: (done, total) => calls.push([done, total]),
      }),
    );
    // Two blocks go through all four steps, then the third one.
    expect(calls).toEqual([2, 4, 6, 8, 9, 10, 11, 12].map((done) => [done, 12]));
  });

  it('stops before the next step when a message cancels it while a step runs', async () => {
    const controller = new AbortController();
    let steps = 0;
    const runStep: StepRunner = (input) => {
      steps += 1;
      // As a message from the page would: in a task of its own, after this run.
      if (steps === 2) setTimeout(() => controller.abort(new Error('enough')));
      return mixing(input);
    };
    await expect(sample(sampling(10, { runStep, signal: controller.signal }))).rejects.toThrow('enough');
    expect(steps).toBe(2);
    expect(unfreed).toBe(0);
  });

  it('frees what the steps returned', async () => {
    await sample(sampling(50, { blocksPerRun: 2 }));
    expect(unfreed).toBe(0);
  });
});
