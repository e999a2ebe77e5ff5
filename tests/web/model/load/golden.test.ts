/** The chain on the real runtime: the tiny model's graphs in onnxruntime's wasm build, held against PyTorch. */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { conditionClip } from '../../../../web/model/sample/condition';
import { goldenError } from '../../../../web/model/load/golden';
import { GRAPHS, type GraphName } from '../../../../web/model/manifest';
import { noise } from '../../../../web/model/sample/noise';
import { sample, type Sampling } from '../../../../web/model/sample/sampler';
import { ddim } from '../../../../web/model/sample/schedule';
import { openSession } from '../../../../web/model/load/session';
import { maxDifference, type OpenedModel, openModel, TINY } from '../../support/open-model';

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

function sampling(changes: Partial<Sampling> = {}): Sampling {
  const { manifest, golden, session } = model;
  return {
    latent: manifest.latent,
    alternatingPhase: manifest.diffusion.alternating_phase,
    schedule: ddim(manifest.diffusion, golden.steps),
    latents,
    memory: array('memory'),
    guidance: golden.guidance,
    musicGuidance: golden.musicGuidance,
    noise: noise(golden.seed, latents, width),
    runStep: session.step,
    blocksPerRun: 100,
    ...changes,
  };
}

describe('the tiny model on wasm', () => {
  it('is the one its manifest lists', () => {
    for (const name of GRAPHS) {
      for (const file of Object.values(model.manifest.graphs[name].files)) {
        const bytes = readFileSync(new URL(file.path, TINY));
        expect(bytes.length).toBe(file.bytes);
        expect(createHash('sha256').update(bytes).digest('hex')).toBe(file.sha256);
      }
    }
  });

  it('starts from the same noise as Python', () => {
    expect(maxDifference(noise(model.golden.seed, latents, width, 0), array('initial'))).toBeLessThan(1e-6);
  });

  it('computes the same memory, in one piece and in chunks', async () => {
    const { session, golden, manifest } = model;
    for (const size of [latents, 40, 7]) {
      const memory = await conditionClip(session.condition, golden, manifest, size);
      expect(maxDifference(memory, array('memory'))).toBeLessThan(1e-4);
    }
  });

  it('agrees with PyTorch after every step of a whole sampling', async () => {
    const [xs, x0s] = [array('x'), array('x0')];
    const size = latents * width;
    const seen: number[] = [];
    await sample(
      sampling({
        onStep: (k, x, x0) => {
          seen.push(
            maxDifference(x, xs.subarray(k * size, (k + 1) * size)),
            maxDifference(x0, x0s.subarray(k * size, (k + 1) * size)),
          );
        },
      }),
    );
    expect(seen).toHaveLength(2 * model.golden.steps);
    expect(Math.max(...seen)).toBeLessThan(1e-4);
  });

  it('decodes the same joints from all layers and from the coarse one alone', async () => {
    const { session, golden } = model;
    const last = array('x').subarray(-latents * width);
    for (const [name, layers] of [
      ['reactor', [1, 1]],
      ['coarse', [1, 0]],
    ] as const) {
      const input = { latents: last, leader: golden.leader, layers: new Float32Array(layers) };
      const joints = await session.decode(input);
      expect(maxDifference(joints, array(name))).toBeLessThan(1e-4);
    }
    expect(maxDifference(array('reactor'), array('coarse'))).toBeGreaterThan(0.001);
  });

  it('keeps the coarse latents bit by bit when only the fine guidance changes', async () => {
    const { channels, layers } = model.manifest.latent;
    const guided = (fine: number): Promise<Float32Array> =>
      sample(
        sampling({ guidance: model.golden.guidance.map((s, i) => (i % layers.length === 1 ? fine : s)) }),
      );
    const layer = (x: Float32Array, r: number): Float32Array =>
      x.filter((_, i) => Math.floor(i / channels) % layers.length === r);
    const [low, high] = [await guided(-1), await guided(3)];
    expect(layer(low, 0)).toEqual(layer(high, 0));
    expect(maxDifference(layer(low, 1), layer(high, 1))).toBeGreaterThan(0.1);
  });

  it('gives the same latents however many blocks go through the graph at once', async () => {
    const whole = await sample(sampling());
    for (const blocksPerRun of [1, 2]) {
      expect(maxDifference(await sample(sampling({ blocksPerRun })), whole)).toBeLessThan(1e-5);
    }
  });

  it('computes one block alone as inside the whole clip', async () => {
    const { block, memory_width: memoryWidth } = model.manifest.latent;
    const whole = await sample(sampling({ alternatingPhase: false }));
    const alone = await sample(
      sampling({
        alternatingPhase: false,
        latents: block,
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
      step: async (input: Parameters<typeof session.step>[0]) => {
        const output = await session.step(input);
        output.x[3 * width] = (output.x[3 * width] ?? 0) + 0.5;
        return output;
      },
    };
    expect(await goldenError(manifest, spoiled, golden)).toBeGreaterThan(1e-3);
    const silent = { ...session, decode: () => Promise.resolve(golden.reactor.map(() => NaN)) };
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
    expect(maxDifference(results[0], array('memory'))).toBeLessThan(1e-4);
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
