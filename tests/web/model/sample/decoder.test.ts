/** Parts of a dance beside the whole, on the tiny model in onnxruntime's wasm build. */
import { afterAll, beforeAll, expect, it } from 'vitest';
import { decodeClip, meanLengths } from '../../../../web/model/sample/decoder';
import { noise } from '../../../../web/model/sample/noise';
import { maxDifference, type OpenedModel, openModel, TINY } from '../../support/open-model';

let model: OpenedModel;
beforeAll(async () => {
  model = await openModel(TINY);
}, 60_000);
afterAll(() => model.session.release());

it('decodes a part as the whole does, and gives every bone its length', async () => {
  const { manifest, session, golden } = model;
  const { latent } = manifest;
  const latents = golden.musicValid.length / latent.stride;
  const gains = new Float32Array(6).fill(1);
  const request = {
    latents: noise(3, latents, latent.layers.length * latent.channels),
    leader: golden.leader,
    gains,
    bones: golden.bones,
  };
  const whole = await decodeClip(session, manifest, request);
  const range = { start: 60, end: 75 };
  const part = await decodeClip(session, manifest, request, { range });
  const perLatent = latent.stride * 66;
  const expected = whole.joints.subarray(range.start * perLatent, range.end * perLatent);
  expect(part.joints).toHaveLength(expected.length);
  expect(maxDifference(part.joints, expected)).toBeLessThan(1e-5);
  expect(meanLengths(whole.lengths, 22)).toHaveLength(22);
  const elbow = [0, 1, 2].map((axis) => part.joints[18 * 3 + axis]! - part.joints[16 * 3 + axis]!);
  expect(Math.hypot(...elbow)).toBeCloseTo(golden.bones[18]!, 3);
});
