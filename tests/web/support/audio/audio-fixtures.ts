import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { readRecipe } from '../../../../web/audio/recipe';

/** A song with librosa's features of it. */
export interface ReferenceSong {
  readonly name: string;
  /** Mono at the recipe's rate. */
  readonly audio: Float32Array;
  /** frames x recipe.features */
  readonly features: Float32Array;
  /** Beats per minute. */
  readonly tempo: number;
}

/** Path of a file that tests/fixtures/make_audio.py made. */
export function fixture(name: string): string {
  return fileURLToPath(new URL(`../../../fixtures/audio/${name}`, import.meta.url));
}

const golden = JSON.parse(readFileSync(fixture('golden.json'), 'utf8')) as {
  recipe: unknown;
  songs: Record<string, { tempo: number }>;
};

/** The recipe as Python authored it. */
export const recipe = readRecipe(golden.recipe);

/** The made songs. */
export const songs: ReferenceSong[] = Object.entries(golden.songs).map(([name, { tempo }]) => ({
  name,
  tempo,
  audio: readWav(fixture(`${name}.wav`)),
  features: readFloats(fixture(`${name}.f32`)),
}));

/** Raw little-endian float32 values. */
export function readFloats(path: string): Float32Array {
  const bytes = readFileSync(path);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

/** Samples of a mono 16-bit WAV with the plain 44-byte header that the fixtures have. */
export function readWav(path: string): Float32Array {
  const bytes = readFileSync(path);
  const samples = new Int16Array(
    bytes.buffer.slice(bytes.byteOffset + 44, bytes.byteOffset + bytes.byteLength),
  );
  return Float32Array.from(samples, (sample) => sample / 32768);
}
