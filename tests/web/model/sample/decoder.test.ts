/** Parts of a dance beside the whole, on the tiny model in onnxruntime's wasm build. */
import { afterAll, beforeAll, expect, it } from 'vitest';
import { decodeClip } from '../../../../web/model/sample/decoder';
import type { DecodeInput } from '../../../../web/model/sample/graphs';
import type { ModelSession } from '../../../../web/model/load/session';
import { noise } from '../../../../web/model/sample/noise';
import { maxDifference, type OpenedModel, openModel, TINY } from '../../support/open-model';
import { small } from '../../support/small-manifest';

let model: OpenedModel;
beforeAll(async () => {
  model = await openModel(TINY);
}, 60_000);
afterAll(() => model.session.release());

it('decodes a part as the whole does, on the body of the role', async () => {
  const { manifest, session, golden } = model;
  const { latent } = manifest;
  const latents = golden.musicValid.length / latent.stride;
  const gains = new Float32Array(6).fill(1);
  const request = {
    latents: noise(3, latents, latent.layers.length * latent.channels),
    leader: golden.leader,
    gains,
    role: 0,
  };
  const whole = await decodeClip(session, manifest, request);
  const range = { start: 60, end: 75 };
  const part = await decodeClip(session, manifest, request, { range });
  const perLatent = latent.stride * 66;
  const expected = whole.subarray(range.start * perLatent, range.end * perLatent);
  expect(part).toHaveLength(expected.length);
  expect(maxDifference(part, expected)).toBeLessThan(1e-5);
  const leading = await decodeClip(session, manifest, { ...request, role: 1 }, { range });
  const { bodies } = manifest.skeleton;
  for (const [motion, body] of [
    [part, bodies.reactor],
    [leading, bodies.leader],
  ] as const) {
    const arm = [0, 1, 2].map((axis) => motion[18 * 3 + axis]! - motion[16 * 3 + axis]!);
    expect(Math.hypot(...arm)).toBeCloseTo(Math.hypot(...body[18]!), 4);
  }
  expect(Math.hypot(...bodies.leader[18]!)).toBeGreaterThan(1.05 * Math.hypot(...bodies.reactor[18]!));
});

it('can be given up between two parts of a long dance', async () => {
  const { latent } = small;
  const frames = 1300 * latent.stride;
  const given = new AbortController();
  let runs = 0;
  const session = {
    decode: ({ leader }: DecodeInput) => {
      runs++;
      given.abort(new Error('A newer request.'));
      return Promise.resolve(new Float32Array(leader.length));
    },
  } as unknown as ModelSession;
  const request = {
    latents: new Float32Array(1300 * latent.layers.length * latent.channels),
    leader: new Float32Array(frames * 66),
    gains: new Float32Array(6),
    role: 0,
  };
  await expect(decodeClip(session, small, request, { signal: given.signal })).rejects.toThrow(
    'A newer request.',
  );
  expect(runs).toBe(1);
});
