import { describe, expect, it } from 'vitest';
import { AppError } from '../../../web/common/error';
import { parseManifest } from '../../../web/model/manifest';
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
    ['another format', (json) => void (json.format = 'other'), 'model-unsupported'],
    ['another version', (json) => void (json.version = 1), 'model-unsupported'],
    ['another noise', (json) => void (json.noise.algorithm = 'mt19937'), 'manifest-invalid'],
    ['other joints', (json) => void (json.skeleton.joints[3] = 'tail'), 'model-unsupported'],
    ['another floor', (json) => void (json.skeleton.floor.toe_rest = 0.05), 'model-unsupported'],
    ['other parents', (json) => void (json.skeleton.parents[3] = 1), 'model-unsupported'],
    ['a short schedule', (json) => void json.diffusion.alphas_cumprod.pop(), 'manifest-invalid'],
    ['channels that do not divide', (json) => void (json.latent.channels = 4), 'manifest-invalid'],
    ['default steps out of range', (json) => void (json.diffusion.steps.default = 60), 'manifest-invalid'],
    ['weights out of range', (json) => void (json.guidance.variety.default = 3), 'manifest-invalid'],
    ['no seeds for the mean', (json) => void (json.guidance.variety.seeds = 0), 'manifest-invalid'],
    [
      'a capsule between no joints',
      (json) => void (json.quality.penetration.capsules[0]!.to = 'tail'),
      'manifest-invalid',
    ],
    ['a list', () => [], 'manifest-invalid'],
    ['a string', () => 'manifest', 'manifest-invalid'],
  ])('refuses %s', (_, change, code) => {
    expect(failure(change).code).toBe(code);
  });
});
