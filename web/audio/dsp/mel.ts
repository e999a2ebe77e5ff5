import { type FilterBank, filterBank } from './filters';
import type { AudioRecipe } from '../recipe';

/** Slaney's scale: linear up to 1000 Hz, then 27 steps for every factor of 6.4. */
const HZ_PER_MEL = 200 / 3;
const LOG_START_HZ = 1000;
const LOG_START_MEL = LOG_START_HZ / HZ_PER_MEL;
const LOG_STEP = Math.log(6.4) / 27;

function hzToMel(hz: number): number {
  return hz < LOG_START_HZ ? hz / HZ_PER_MEL : LOG_START_MEL + Math.log(hz / LOG_START_HZ) / LOG_STEP;
}

function melToHz(mel: number): number {
  return mel < LOG_START_MEL ? mel * HZ_PER_MEL : LOG_START_HZ * Math.exp(LOG_STEP * (mel - LOG_START_MEL));
}

/** The Slaney mel filters: triangles of equal area, evenly spaced in mel (`librosa.filters.mel`, norm 'slaney'). */
export function melFilters(recipe: AudioRecipe): FilterBank {
  const low = hzToMel(recipe.mel_fmin);
  const step = (hzToMel(recipe.mel_fmax) - low) / (recipe.mels + 1);
  const rows = Array.from({ length: recipe.mels }, (_, band) => {
    const [left, centre, right] = [band, band + 1, band + 2].map((edge) => melToHz(low + edge * step)) as [
      number,
      number,
      number,
    ];
    return Float64Array.from({ length: recipe.n_fft / 2 + 1 }, (_, bin) => {
      const hz = (bin * recipe.sample_rate) / recipe.n_fft;
      const height = Math.min((hz - left) / (centre - left), (right - hz) / (right - centre));
      return (Math.max(0, height) * 2) / (right - left);
    });
  });
  return filterBank(rows);
}
