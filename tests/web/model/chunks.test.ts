import { describe, expect, it } from 'vitest';
import {
  chunks,
  conditionClip,
  type ConditionRunner,
  decodeClip,
  type DecodeRunner,
} from '../../../web/model/chunks';
import { small } from './small-manifest';

const { latent, audio } = small;
const width = latent.layers.length * latent.channels;

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
  return Promise.resolve(
    Float32Array.from({ length: latents * 2 }, (_, k) => {
      const i = Math.floor(k / 2);
      return at(signal, i - 2) + 2 * at(signal, i) + 3 * at(signal, i + 2) + (k % 2);
    }),
  );
};

/** Stands in for the decode graph: looks three latent frames to each side. */
const decode: DecodeRunner = ({ latents, leader, layers }) => {
  const length = latents.length / width;
  const signal = Array.from({ length }, (_, i) => (latents[i * width] ?? NaN) * (layers[0] ?? NaN));
  return Promise.resolve(
    leader.map((value, k) => {
      const i = Math.floor(k / 264);
      return value + at(signal, i - 3) - at(signal, i + 3);
    }),
  );
};

describe('chunks', () => {
  it('wants every latent frame once, with its surroundings as far as the clip goes', () => {
    expect(chunks(25, 10, 3)).toEqual([
      { start: 0, end: 10, from: 0, to: 13 },
      { start: 10, end: 20, from: 7, to: 23 },
      { start: 20, end: 25, from: 17, to: 25 },
    ]);
    expect(chunks(5, 10, 3)).toEqual([{ start: 0, end: 5, from: 0, to: 5 }]);
  });
});

describe('a clip in chunks', () => {
  const values = (length: number): Float32Array => Float32Array.from({ length }, (_, i) => Math.sin(i));

  it('has the same memory as in one piece', async () => {
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
        expect(await conditionClip(condition, input, small, size)).toEqual(whole);
      }
    }
  });

  it('has the same joints as in one piece, with progress', async () => {
    const input = { latents: values(13 * width), leader: values(13 * 264), layers: new Float32Array([1, 1]) };
    const whole = await decode(input);
    const progress: number[] = [];
    const onProgress = (done: number, total: number): void => void progress.push(done / total);
    expect(await decodeClip(decode, input, small, 4, { onProgress })).toEqual(whole);
    expect(progress).toEqual([0.25, 0.5, 0.75, 1]);
  });

  it('stops between chunks', async () => {
    const controller = new AbortController();
    let runs = 0;
    const run: DecodeRunner = (input) => {
      runs += 1;
      setTimeout(() => controller.abort());
      return decode(input);
    };
    const input = { latents: values(13 * width), leader: values(13 * 264), layers: new Float32Array([1, 1]) };
    const result = decodeClip(run, input, small, 4, { signal: controller.signal });
    await expect(result).rejects.toThrow(/abort/i);
    expect(runs).toBe(1);
  });
});
