import { describe, expect, it } from 'vitest';
import { musicFeatures } from '../../../web/audio/features';
import { recipe, songs } from '../support/audio/audio-fixtures';
import { beatFrames } from '../support/audio/feature-parity';

describe('music features of odd songs', () => {
  it.each([1, 100, recipe.hop - 1, recipe.hop, recipe.n_fft - 1, 3 * recipe.n_fft])(
    'silence of %i samples',
    (length) => {
      const { frames, features } = musicFeatures(new Float32Array(length), recipe);
      expect(frames).toBe(1 + Math.floor(length / recipe.hop));
      expect(features).toEqual(new Float32Array(frames * recipe.features));
    },
  );

  it.each([1, 100, recipe.hop, recipe.n_fft - 1, 2 * recipe.n_fft])('%i samples of music', (length) => {
    const { frames, features } = musicFeatures(songs[0]!.audio.subarray(5000, 5000 + length), recipe);
    expect(features.length).toBe(frames * recipe.features);
    expect(features.every(Number.isFinite)).toBe(true);
  });

  it('a steady tone, which has no onset after its first', () => {
    const tone = Float32Array.from({ length: 5 * recipe.sample_rate }, (_, i) => 0.5 * Math.sin(i * 0.18));
    const { features } = musicFeatures(tone, recipe);
    expect(features.every(Number.isFinite)).toBe(true);
    expect(beatFrames(features, recipe).length).toBeLessThanOrEqual(1);
  });

  it('reports progress that ascends to 1', () => {
    const heard: number[] = [];
    musicFeatures(songs[0]!.audio, recipe, (fraction) => heard.push(fraction));
    expect(heard.length).toBeGreaterThan(20);
    expect(heard).toEqual(heard.toSorted((a, b) => a - b));
    expect(heard.at(-1)).toBe(1);
  });
});
