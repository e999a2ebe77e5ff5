import { expose, transfer } from 'comlink';
import { analyse, type Analysis } from './analyse';
import type { AudioRecipe } from './recipe';

/** The call that the audio worker answers; its arguments are those of `analyse`. */
const api = {
  analyse(
    channels: Float32Array[],
    sampleRate: number,
    recipe: AudioRecipe,
    onProgress: (fraction: number) => void,
  ): Analysis {
    const analysis = analyse(channels, sampleRate, recipe, onProgress);
    return transfer(analysis, [analysis.pcm.buffer, analysis.features.buffer]);
  },
};

export type AudioWorker = typeof api;

expose(api);
