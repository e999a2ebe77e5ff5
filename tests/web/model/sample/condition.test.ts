import { describe, expect, it } from 'vitest';
import { chunks, conditionClip } from '../../../../web/model/sample/condition';
import type { ConditionRunner } from '../../../../web/model/sample/graphs';
import { small } from '../../support/small-manifest';

const { latent, audio } = small;

/** A value at a latent frame, zero outside what was given: the padding of a convolution. */
const at = (values: readonly number[], i: number): number => values[i] ?? 0;

/** Stands in for the condition graph: looks two latent frames to each side. */
const condition: ConditionRunner = ({ leader, music, musicValid, role }) => {
  const latents = musicValid.length / latent.stride;
  const signal = Array.from(
    { length: latents },
    (_, i) =>
      (leader[i * 264] ?? NaN) + (music[i * 4 * audio.features] ?? NaN) * (musicValid[i * 4] ?? NaN) + role,
  );
  return Promise.resolve({
    memory: Float32Array.from({ length: latents * 2 }, (_, k) => {
      const i = Math.floor(k / 2);
      return at(signal, i - 2) + 2 * at(signal, i) + 3 * at(signal, i + 2) + (k % 2);
    }),
    unfamiliarity: Float32Array.from({ length: latents }, (_, i) => Math.abs(leader[i * 264] ?? NaN)),
  });
};

describe('chunks', () => {
  it('cover every latent frame once, with the receptive field around as far as the clip goes', () => {
    expect(chunks(25, 10, 3)).toEqual([
      { start: 0, end: 10, inputStart: 0, inputEnd: 13 },
      { start: 10, end: 20, inputStart: 7, inputEnd: 23 },
      { start: 20, end: 25, inputStart: 17, inputEnd: 25 },
    ]);
    expect(chunks(5, 10, 3)).toEqual([{ start: 0, end: 5, inputStart: 0, inputEnd: 5 }]);
  });

  it('of a part reach as far beyond its ends', () => {
    expect(chunks(100, 10, 3, { start: 20, end: 34 })).toEqual([
      { start: 20, end: 30, inputStart: 17, inputEnd: 33 },
      { start: 30, end: 34, inputStart: 27, inputEnd: 37 },
    ]);
  });
});

describe('a clip in chunks', () => {
  const values = (length: number): Float32Array => Float32Array.from({ length }, (_, i) => Math.sin(i));

  const silence = (latents: number) => ({
    leader: values(latents * 264),
    music: values(latents * 4 * audio.features),
    musicValid: new Float32Array(latents * 4),
    role: 0,
  });

  it('has the same memory and mean unfamiliarity as in one piece', async () => {
    for (const latents of [1, 5, 13, 40]) {
      const musicValid = new Float32Array(latents * 4).fill(1, 0, latents * 2);
      const input = {
        leader: values(latents * 264),
        music: values(latents * 4 * audio.features),
        musicValid,
        role: 1,
      };
      const whole = await condition(input);
      for (const size of [1, 4, 7, 100]) {
        const { memory, unfamiliarity } = await conditionClip(condition, input, small, size);
        expect(memory).toEqual(whole.memory);
        const mean = whole.unfamiliarity.reduce((sum, value) => sum + value, 0) / latents;
        expect(unfamiliarity).toBeCloseTo(mean, 5);
      }
    }
  });

  it('reports its progress', async () => {
    const progress: number[] = [];
    const onProgress = (done: number, total: number): void => void progress.push(done / total);
    await conditionClip(condition, silence(13), small, 4, { onProgress });
    expect(progress).toEqual([0.25, 0.5, 0.75, 1]);
  });

  it('stops between chunks', async () => {
    const controller = new AbortController();
    let runs = 0;
    const run: ConditionRunner = (input) => {
      runs += 1;
      setTimeout(() => controller.abort());
      return condition(input);
    };
    const result = conditionClip(run, silence(13), small, 4, { signal: controller.signal });
    await expect(result).rejects.toThrow(/abort/i);
    expect(runs).toBe(1);
  });
});
