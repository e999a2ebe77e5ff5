import { describe, expect, it } from 'vitest';
import { readRecipe } from '../../../web/audio/recipe';
import { recipe } from '../support/audio/audio-fixtures';

describe('the audio recipe', () => {
  it('is accepted as Python writes it', () => {
    expect(readRecipe({ ...recipe })).toEqual(recipe);
  });

  it.each([
    ['a missing number', { ...recipe, hop: undefined }, /hop/],
    ['an even kernel', { ...recipe, hpss_kernel: 30 }, /hpss_kernel.*odd/],
    ['a window that is no power of two', { ...recipe, n_fft: 2000 }, /n_fft.*power of two/],
    ['columns that do not add up', { ...recipe, features: 53 }, /features/],
    ['a column too many', { ...recipe, features: 55 }, /features/],
    ['more cepstra than bands', { ...recipe, mels: recipe.mfcc - 1 }, /mfcc as mels/],
    ['a band above half the rate', { ...recipe, mel_fmax: recipe.sample_rate / 2 + 1 }, /mel_fmax/],
    ['a band without width', { ...recipe, mel_fmin: recipe.mel_fmax }, /mel_fmin below/],
    ['nothing', undefined, /audio/],
  ])('is refused with %s', (_, block, words) => {
    expect(() => readRecipe(block)).toThrow(
      expect.objectContaining({ code: 'bad-recipe', message: expect.stringMatching(words) as string }),
    );
  });
});
