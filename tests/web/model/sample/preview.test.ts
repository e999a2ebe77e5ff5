/** The block on view is generated first: near to its final motion, and without any effect on the result. */
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { GenerateRequest } from '../../../../web/model/sample/inputs';
import { Pipeline } from '../../../../web/model/sample/pipeline';
import type { GenerateResult, Preview } from '../../../../web/model/sample/results';
import { blockAt, fillAround, shouldPreview, shouldShowPart } from '../../../../web/model/sample/preview';
import type { Progress } from '../../../../web/model/progress';
import { maxDifference, type OpenedModel, openModel, TINY } from '../../support/open-model';

let model: OpenedModel;
beforeAll(async () => {
  model = await openModel(TINY);
}, 60_000);
afterAll(() => model.session.release());

/** On a machine so slow that a preview of the tiny model pays. */
const open = (): Pipeline => new Pipeline(model.manifest, model.session, () => performance.now() / 10);

/** Four blocks unless told otherwise: the golden leader, forth and back, so that it does not jump. */
function request(changes: Partial<GenerateRequest> = {}, blocks = 4): GenerateRequest {
  const { golden, manifest } = model;
  const [frames, there] = [blocks * 240 - 7, golden.leader.length / 66];
  const at = (frame: number): number => {
    const phase = frame % (2 * there);
    return phase < there ? phase : 2 * there - 1 - phase;
  };
  const pick = (values: Float32Array, width: number): Float32Array =>
    Float32Array.from(
      { length: frames * width },
      (_, i) => values[at(Math.floor(i / width)) * width + (i % width)] ?? 0,
    );
  return {
    leader: { fps: 30, frames, positions: pick(golden.leader, 66) },
    music: { features: pick(golden.music, manifest.audio.features), frames },
    guidance: new Float32Array(6),
    musicGuidance: 0,
    steps: 3,
    seed: 1,
    ...changes,
  };
}

async function generate(
  pipeline: Pipeline,
  changes: Partial<GenerateRequest>,
  at: number,
  blocks?: number,
): Promise<{ result: GenerateResult; previews: Preview[]; progress: Progress[] }> {
  const previews: Preview[] = [];
  const progress: Progress[] = [];
  const result = await pipeline.generate(request(changes, blocks), {
    at,
    onPreview: (preview) => previews.push(preview),
    onProgress: (told) => progress.push(told),
  });
  return { result, previews, progress };
}

describe('a generation with a frame on view', { timeout: 90_000 }, () => {
  it('computes no block twice where blocks have no neighbours to wait for', async () => {
    const { manifest, session } = model;
    const diffusion = { ...manifest.diffusion, alternating_phase: false };
    let computed = 0;
    const counting = {
      ...session,
      step: (input: Parameters<typeof session.step>[0]) => {
        computed += input.blocks;
        return session.step(input);
      },
    };
    const slow = (): number => performance.now() / 10;
    const pipeline = new Pipeline({ ...manifest, diffusion }, counting, slow);
    const expected = await pipeline.generate(request());
    expect(computed).toBe(3 * 4);
    computed = 0;
    const { result, previews } = await generate(pipeline, {}, 500);
    expect(computed).toBe(3 * 4);
    expect(maxDifference(result.motion.positions, expected.motion.positions)).toBe(0);
    expect(previews[0]?.fresh).toEqual({ from: 480, to: 720 });
  });

  it('hands over the block on view, and gives the same motion as without', async () => {
    const [plain, watched] = [open(), open()];
    const changes = { guidance: new Float32Array(6).fill(2), seed: 9 };
    const expected = await plain.generate(request(changes));
    // A first run, so that the preview stands among the latents of another reaction.
    const first = await watched.generate(request());
    const { result, previews, progress } = await generate(watched, changes, 500);
    for (const made of ['motion', 'locked'] as const) {
      for (const part of ['offsets', 'root', 'rotations', 'positions'] as const) {
        expect(maxDifference(result[made][part], expected[made][part])).toBe(0);
      }
    }
    expect(previews.map(({ fresh }) => fresh)).toEqual([{ from: 480, to: 720 }]);
    const fractions = progress.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(progress.some(({ stage }) => stage === 'preview')).toBe(true);

    const [preview] = previews;
    const inside = (positions: Float32Array): Float32Array => positions.subarray(500 * 66, 700 * 66);
    const before = inside(first.motion.positions);
    const after = inside(expected.motion.positions);
    const early = inside(preview!.motion.positions);
    expect(preview!.motion.frames).toBe(request().leader.frames);
    // With random weights a block depends on its neighbours, which it lacks when sampled alone.
    expect(mean(early, after)).toBeLessThan(0.7 * mean(before, after));
  });

  it('shows growing parts around it, which are part of the result and cost no more blocks', async () => {
    const blocks = 8;
    const [plain, watched] = [open(), open()];
    const steps: number[] = [0, 0];
    const counted = async (pipeline: Pipeline, i: number, at?: number): Promise<Preview[]> => {
      const previews: Preview[] = [];
      await pipeline.generate(request({}, blocks), {
        at,
        onPreview: (preview) => previews.push(preview),
        onProgress: ({ stage, done }) => {
          if (stage === 'step') steps[i] = done;
        },
      });
      return previews;
    };
    const first = await plain.generate(request({ seed: 4 }, blocks));
    await watched.generate(request({ seed: 4 }, blocks));
    const previews = await counted(watched, 0, 5.5 * 240);
    await counted(plain, 1);
    expect(steps[0]).toBe(steps[1]);
    expect(previews.map(({ fresh }) => fresh)).toEqual([
      { from: 5 * 240, to: 6 * 240 },
      { from: 4 * 240, to: 7 * 240 },
    ]);
    const whole = await open().generate(request({}, blocks));
    const inner = ({ motion }: Pick<Preview, 'motion'>): Float32Array =>
      motion.positions.subarray(4.5 * 240 * 66, 6.5 * 240 * 66);
    const moved = mean(inner(first), inner(whole));
    expect(moved).toBeGreaterThan(0.001);
    // The bones are those of the whole clip, so the last millimetre waits for it.
    expect(mean(inner(previews[1]!), inner(whole))).toBeLessThan(0.1 * moved);
  });

  it('shows a preview in the first generation too, and at the end of the clip', async () => {
    const { previews } = await generate(open(), {}, 99_999);
    expect(previews[0]?.fresh).toEqual({ from: 3 * 240, to: 4 * 240 - 7 });
    expect(previews[0]?.motion.positions.every(Number.isFinite)).toBe(true);
  });

  it('shows no preview of a generation that takes no time', async () => {
    const { leader, music } = request();
    const short = { ...leader, frames: 300, positions: leader.positions.slice(0, 300 * 66) };
    const { previews, progress } = await generate(open(), { leader: short, music }, 0);
    expect(previews).toEqual([]);
    expect(progress.every(({ stage }) => stage !== 'preview')).toBe(true);
  });

  it('can be cancelled during the preview', async () => {
    const controller = new AbortController();
    const previews: Preview[] = [];
    const result = open().generate(request(), {
      signal: controller.signal,
      at: 0,
      onPreview: (preview) => previews.push(preview),
      onProgress: ({ stage }) => {
        if (stage === 'preview') controller.abort();
      },
    });
    await expect(result).rejects.toThrow(/abort/i);
    expect(previews).toEqual([]);
  });
});

describe('what is previewed', () => {
  it('is a small part of a generation that takes a while', () => {
    expect(shouldPreview(7, 22, undefined)).toBe(true);
    expect(shouldPreview(7, 12, undefined)).toBe(false);
    expect(shouldPreview(7, 22, 0.1)).toBe(true);
    expect(shouldPreview(7, 22, 0.01)).toBe(false);
  });
  it('is a growing part while enough work remains', () => {
    expect(shouldShowPart(0.3, 22, undefined)).toBe(true);
    expect(shouldShowPart(0.1, 22, undefined)).toBe(false);
    expect(shouldShowPart(0.3, 22, 0.1)).toBe(true);
    expect(shouldShowPart(0.3, 22, 0.01)).toBe(false);
  });
  it('is the block that contains the frame on view', () => {
    expect(blockAt(100, 60, 59.9)).toEqual({ start: 0, length: 60 });
    expect(blockAt(100, 60, 60)).toEqual({ start: 60, length: 40 });
    expect(blockAt(100, 60, 500)).toEqual({ start: 60, length: 40 });
  });
  it('is surrounded by earlier latents, or repeated', () => {
    const block = Float32Array.of(1, 2);
    const at = { start: 2, length: 2 };
    expect([...fillAround(block, at, Float32Array.of(9, 9, 9, 9, 9), 5, 1)]).toEqual([9, 9, 1, 2, 9]);
    expect([...fillAround(block, at, null, 5, 1)]).toEqual([1, 2, 1, 2, 1]);
  });
});

function mean(a: Float32Array, b: Float32Array): number {
  return a.reduce((sum, value, i) => sum + Math.abs(value - (b[i] ?? NaN)), 0) / a.length;
}
