/** The chain on the real runtime: the tiny model's graphs in onnxruntime's wasm build, held against PyTorch. */
import { readFileSync } from 'node:fs';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { conditionClip } from '../../../../web/model/sample/condition';
import { goldenError } from '../../../../web/model/load/golden';
import type { GraphName } from '../../../../web/model/manifest';
import { noise } from '../../../../web/model/sample/noise';
import { blend, coarseAlone, layerGains } from '../../../../web/model/sample/blend';
import { BranchSampler } from '../../../../web/model/sample/branch-sampler';
import type { StepInput } from '../../../../web/model/sample/graphs';
import { Pipeline } from '../../../../web/model/sample/pipeline';
import { sample, type Sampling } from '../../../../web/model/sample/sampler';
import { ddim } from '../../../../web/model/sample/schedule';
import { type ModelSession, openSession } from '../../../../web/model/load/session';
import { solve } from '../../../../web/motion/fit/ik';
import { maxDifference, type OpenedModel, openModel, otherFiles, TINY } from '../../support/open-model';

let model: OpenedModel;
let latents: number;
let width: number;

beforeAll(async () => {
  model = await openModel(TINY);
  const { latent } = model.manifest;
  latents = model.golden.musicValid.length / latent.stride;
  width = latent.layers.length * latent.channels;
}, 60_000);
afterAll(() => model.session.release());

const array = (name: string): Float32Array => Float32Array.from(model.arrays.get(name)?.data ?? []);

/** The sampling of the golden scene's conditional branch. */
function sampling(changes: Partial<Sampling> = {}): Sampling {
  const { manifest, golden, session } = model;
  return {
    latent: manifest.latent,
    schedule: ddim(manifest.diffusion),
    memory: array('memory'),
    keep: 1,
    noise: noise(golden.seed, latents, width),
    runStep: session.step,
    blocksPerRun: 100,
    ...changes,
  };
}

describe('the tiny model on wasm', () => {
  it('is the one its manifest lists', () => {
    expect(otherFiles(TINY, model.manifest)).toEqual([]);
  });

  it('starts from the same noise as Python', () => {
    expect(maxDifference(noise(model.golden.seed, latents, width, 0), array('initial'))).toBeLessThan(1e-6);
  });

  it('computes the same memory with and without the song, in one piece and in chunks', async () => {
    const { session, golden, manifest } = model;
    const silent = { ...golden, musicValid: new Float32Array(golden.musicValid.length) };
    for (const size of [latents, 40, 7]) {
      const { memory, unfamiliarity } = await conditionClip(session.condition, golden, manifest, size);
      expect(maxDifference(memory, array('memory'))).toBeLessThan(1e-4);
      const each = array('unfamiliarity');
      expect(unfamiliarity).toBeCloseTo(each.reduce((sum, value) => sum + value, 0) / latents, 3);
    }
    const { memory } = await conditionClip(session.condition, silent, manifest, latents);
    expect(maxDifference(memory, array('silent'))).toBeLessThan(1e-4);
    expect(maxDifference(array('silent'), array('memory'))).toBeGreaterThan(1e-2);
  });

  it('samples the same branches and mean as PyTorch, and blends them alike', async () => {
    const { manifest, session, golden } = model;
    const size = latents * width;
    const branches = await new BranchSampler(manifest, session).branches(golden, golden.seed, {
      silent: true,
      unconditional: true,
      mean: true,
    });
    const sampled = [branches.conditional, branches.silent, branches.unconditional];
    for (const [i, branch] of sampled.entries()) {
      const expected = array('branches').subarray(i * size, (i + 1) * size);
      expect(maxDifference(branch ?? [], expected)).toBeLessThan(1e-4);
    }
    const { channels, layers } = manifest.latent;
    const mean = array('branches').subarray(3 * size);
    const coarse = mean.filter((_, i) => Math.floor(i / channels) % layers.length === 0);
    expect(maxDifference(branches.mean ?? [], coarse)).toBeLessThan(1e-4);
    const blended = blend(branches, { ...golden, variety: 1 }, manifest.latent);
    expect(maxDifference(blended, array('latents'))).toBeLessThan(1e-3);
  });

  it('makes the recorded latents of recorded memory, by the pipeline of the page with its own weights', async () => {
    const { manifest, session, golden } = model;
    const recorded: ModelSession = {
      ...session,
      condition: ({ musicValid }) =>
        Promise.resolve({
          memory: array(musicValid.some((valid) => valid !== 0) ? 'memory' : 'silent'),
          unfamiliarity: array('unfamiliarity'),
        }),
    };
    const frames = golden.musicValid.length;
    const heard = golden.musicValid.filter((valid) => valid !== 0).length;
    const { features } = manifest.audio;
    const { guidance, musicGuidance, seed } = golden;
    const leader = { fps: manifest.fps, frames, positions: golden.leader };
    const asked = {
      ...{ guidance, musicGuidance, seed },
      ...{ leader, fitted: solve(leader) },
      music: { features: golden.music.subarray(0, heard * features), frames: heard },
      variety: 1,
    };
    const pipeline = new Pipeline(manifest, recorded, () => 0);
    expect(maxDifference((await pipeline.generate(asked)).latents, array('latents'))).toBeLessThan(1e-3);
    const plain = await pipeline.generate({ ...asked, guidance: new Float32Array(6), musicGuidance: 0 });
    const conditional = array('branches').subarray(0, latents * width);
    expect(maxDifference(plain.latents, conditional)).toBeLessThan(1e-3);
    expect(maxDifference(array('latents'), conditional)).toBeGreaterThan(0.1);
  });

  it('decodes the same joints with the gains of both layers and from the coarse one alone', async () => {
    const { session, golden, manifest } = model;
    for (const [name, gains] of [
      ['reactor', layerGains(golden.guidance, manifest.latent)],
      ['coarse_alone', coarseAlone(manifest.latent)],
    ] as const) {
      const { leader, role } = golden;
      const reactor = await session.decode({ latents: array('latents'), leader, gains, role });
      expect(maxDifference(reactor, array(name))).toBeLessThan(1e-4);
    }
    expect(maxDifference(array('reactor'), array('coarse_alone'))).toBeGreaterThan(0.001);
  });

  it('gives the same latents however many blocks go through the graph at once', async () => {
    const whole = await sample(sampling());
    for (const blocksPerRun of [1, 2]) {
      expect(maxDifference(await sample(sampling({ blocksPerRun })), whole)).toBeLessThan(1e-5);
    }
  });

  it('computes one block alone as inside the whole clip', async () => {
    const { block, memory_width: memoryWidth } = model.manifest.latent;
    const whole = await sample(sampling());
    const alone = await sample(
      sampling({
        memory: array('memory').subarray(block * memoryWidth, 2 * block * memoryWidth),
        noise: noise(model.golden.seed, block, width, block),
      }),
    );
    expect(maxDifference(alone, whole.subarray(block * width, 2 * block * width))).toBeLessThan(1e-5);
  });

  it('passes its own golden check, and a session with a wrong number does not', async () => {
    const { manifest, session, golden } = model;
    expect(await goldenError(manifest, session, golden)).toBeLessThan(1e-4);
    const spoiled = {
      ...session,
      step: (input: StepInput) => session.step({ ...input, b: 1.1 * input.b }),
    };
    expect(await goldenError(manifest, spoiled, golden)).toBeGreaterThan(1e-3);
    const silent: ModelSession = {
      ...session,
      decode: () => Promise.resolve(golden.reactor.map(() => NaN)),
    };
    expect(await goldenError(manifest, silent, golden)).toBeNaN();
  });

  it('agrees with PyTorch to a few millimetres with products in 8 bits', async () => {
    const { manifest, session, golden } = await openModel(TINY, 'wasm');
    const error = await goldenError(manifest, session, golden);
    await session.release();
    expect(error).toBeLessThan(3e-3);
    expect(error).toBeGreaterThan(1e-4);
  });

  it('runs overlapping calls one after the other', async () => {
    const { session, golden } = model;
    const results = await Promise.all([session.condition(golden), session.condition(golden)]);
    expect(results[0]).toEqual(results[1]);
    expect(maxDifference(results[0].memory, array('memory'))).toBeLessThan(1e-4);
  });

  it('refuses graphs that have other inputs than this page feeds', async () => {
    const read = (name: GraphName): Uint8Array => new Uint8Array(readFileSync(new URL(`${name}.onnx`, TINY)));
    const swapped = { condition: read('decode'), step: read('step'), decode: read('decode') };
    await expect(openSession(model.manifest, swapped, 'wasm', 1)).rejects.toMatchObject({
      code: 'model-mismatch',
      message: expect.stringContaining('"music"') as string,
    });
  });
});
