import { parseManifest } from '../../../web/model/parse-manifest';
import { describe, expect, it } from 'vitest';
import { AppError } from '../../../web/common/error';
import { smallJson } from '../support/small-manifest';

type Json = ReturnType<typeof smallJson>;

function failure(change: (json: Json) => unknown): AppError {
  const json = smallJson();
  const changed = change(json);
  try {
    parseManifest(changed ?? json);
  } catch (error) {
    if (error instanceof AppError) return error;
    throw error;
  }
  throw new Error('the manifest was accepted');
}

describe('parseManifest', () => {
  it('keeps every field, also unknown ones of the audio recipe', () => {
    const json = smallJson();
    expect(parseManifest(json)).toEqual(json);
  });

  it('names a missing field in a sentence', () => {
    const error = failure((json) => void Reflect.deleteProperty(json.latent, 'block'));
    expect(error.code).toBe('manifest-invalid');
    expect(error.message).toBe('The model\'s manifest has no field "latent.block".');
    expect(error.hint).toContain('Export the model again');
  });

  it('names a field of the wrong kind', () => {
    const error = failure((json) => void (json.graphs.step.files.wasm.sha256 = 'abc'));
    expect(error.message).toContain('"graphs.step.files.wasm.sha256"');
  });

  it.each<[string, (json: Json) => unknown, string]>([
    ['memory_width', (json) => void (json.latent.memory_width = 64), '"memory" of the graph "condition"'],
    ['block', (json) => void (json.latent.block = 60), '"x" of the graph "step"'],
    ['features', (json) => void (json.audio.features = 54), '"music" of the graph "condition"'],
    ['streams', (json) => void json.latent.streams.pop(), '"gains" of the graph "decode"'],
    [
      'an axis too many',
      (json) => void json.graphs.step.inputs['keep']!.push(1),
      '"keep" of the graph "step"',
    ],
    [
      'an axis of one length where any is needed',
      (json) => void (json.graphs.condition.inputs['music_valid']![0] = 240),
      '"music_valid" of the graph "condition"',
    ],
  ])('compares %s with what the graphs take', (_, change, words) => {
    expect(failure(change).message).toContain(`declares ${words} as `);
  });

  it('says that a model has more layers than the page steers', () => {
    const error = failure((json) => {
      const { step, decode } = json.graphs;
      json.latent.layers.push('fine_3');
      step.inputs['x']![2] = 3;
      step.outputs['next']![2] = 3;
      decode.inputs['latents']![1] = 3;
      decode.inputs['gains']![1] = 3;
    });
    expect(error.code).toBe('model-unsupported');
    expect(error.message).toBe(
      'The model has the residual layers coarse, fine, fine_3; this page steers models of two, coarse and fine.',
    );
  });

  it('misses a tensor that the page feeds', () => {
    const error = failure((json) => void Reflect.deleteProperty(json.graphs.step.inputs, 'keep'));
    expect(error.message).toBe('The model\'s manifest has no "keep" of the graph "step" among its inputs.');
  });

  it.each<[string, (json: Json) => unknown, string]>([
    ['another format', (json) => void (json.format = 'other'), 'model-unsupported'],
    ['another version', (json) => void (json.version = 1), 'model-unsupported'],
    ['another noise', (json) => void (json.noise.algorithm = 'mt19937'), 'manifest-invalid'],
    ['other joints', (json) => void (json.skeleton.joints[3] = 'tail'), 'model-unsupported'],
    ['another floor', (json) => void (json.skeleton.floor.toe_rest = 0.05), 'model-unsupported'],
    [
      'a body without an arm',
      (json) => void (json.skeleton.bodies.leader[18] = [0, 0, 0]),
      'manifest-invalid',
    ],
    ['a body of too few joints', (json) => void json.skeleton.bodies.reactor.pop(), 'manifest-invalid'],
    ['other parents', (json) => void (json.skeleton.parents[3] = 1), 'model-unsupported'],
    ['a short schedule', (json) => void json.diffusion.alphas_cumprod.pop(), 'manifest-invalid'],
    ['channels that do not fit', (json) => void (json.latent.channels = 4), 'manifest-invalid'],
    ['no steps', (json) => void (json.diffusion.steps = 0), 'manifest-invalid'],
    ['half a step', (json) => void (json.diffusion.steps = 1.5), 'manifest-invalid'],
    ['more steps than train steps', (json) => void (json.diffusion.steps = 1001), 'manifest-invalid'],
    ['weights out of range', (json) => void (json.guidance.variety.default = 3), 'manifest-invalid'],
    ['no seeds for the mean', (json) => void (json.guidance.variety.seeds = 0), 'manifest-invalid'],
    [
      'a capsule between no joints',
      (json) => void (json.quality.penetration.capsules[0]!.to = 'tail'),
      'manifest-invalid',
    ],
    [
      'a file of another site',
      (json) => void (json.graphs.step.files.wasm.path = 'https://example.org/x'),
      'manifest-invalid',
    ],
    [
      'a file outside its folder',
      (json) => void (json.graphs.step.files.wasm.path = '../x.onnx'),
      'manifest-invalid',
    ],
    ['two streams of one name', (json) => void (json.latent.streams[1] = 'upper'), 'manifest-invalid'],
    ['a stream without a name', (json) => void (json.latent.streams[1] = '__proto__'), 'manifest-invalid'],
    ['no example dance', (json) => void Reflect.deleteProperty(json, 'golden'), 'manifest-invalid'],
    [
      'an example dance of any age',
      (json) => void Reflect.deleteProperty(json.golden, 'sha256'),
      'manifest-invalid',
    ],
    ['another first layer', (json) => void (json.latent.layers[0] = 'rough'), 'model-unsupported'],
    ['one layer', (json) => void json.latent.layers.pop(), 'model-unsupported'],
    [
      'a fader without a range',
      (json) => void Object.assign(json.guidance.music, { min: 2, max: 2 }),
      'manifest-invalid',
    ],
    ['a fader of a million steps', (json) => void (json.guidance.music.step = 1e-6), 'manifest-invalid'],
    [
      'a body of 20 metres',
      (json) => void (json.quality.penetration.capsules[0]!.radius = 20),
      'manifest-invalid',
    ],
    ['features at another rate', (json) => void (json.audio.hop = 500), 'manifest-invalid'],
    ['a list', () => [], 'manifest-invalid'],
    ['a string', () => 'manifest', 'manifest-invalid'],
  ])('refuses %s', (_, change, code) => {
    expect(failure(change).code).toBe(code);
  });
});
