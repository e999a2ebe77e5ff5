import * as v from 'valibot';
import { AppError } from '../common/error';

/** Beyond these a song would fill the memory or take hours. */
const positive = v.pipe(v.number(), v.gtValue(0), v.maxValue(1e5));
const count = v.pipe(v.number(), v.integer(), v.minValue(1), v.maxValue(1024));
const odd = v.pipe(
  count,
  v.check((value) => value % 2 === 1, 'Expected an odd number'),
);

/** The manifest's `audio` block. It comes from training/music/recipe.py, which explains each number. */
const schema = v.pipe(
  v.object({
    /** Hz of the mono signal that is analysed. */
    sample_rate: v.pipe(v.number(), v.integer(), v.minValue(4000), v.maxValue(192_000)),
    /** Channels whose mean is less loud than this share of the first one cancel each other out. */
    cancelled_share: v.pipe(v.number(), v.minValue(0), v.maxValue(1)),
    /** Samples between two frames. */
    hop: v.pipe(v.number(), v.integer(), v.minValue(32), v.maxValue(16_384)),
    /** Samples under the Hann window of one frame. */
    n_fft: v.pipe(
      v.number(),
      v.minValue(64),
      v.maxValue(32_768),
      v.check((value) => Number.isInteger(Math.log2(value)), 'Expected a power of two'),
    ),
    mels: count,
    /** Hz. */
    mel_fmin: v.pipe(v.number(), v.minValue(0), v.maxValue(1e5)),
    /** Hz. */
    mel_fmax: positive,
    amin: positive,
    top_db: positive,
    mfcc: count,
    /** Frames. */
    delta_width: odd,
    /** Frames and bins. */
    hpss_kernel: odd,
    hpss_power: positive,
    chroma: count,
    /** Fractions of a pitch class. */
    chroma_tuning: v.pipe(v.number(), v.minValue(-1), v.maxValue(1)),
    chroma_octave: positive,
    /** Octaves. */
    chroma_octave_width: positive,
    /** Frames. */
    onset_lag: count,
    /** Beats per minute. */
    start_bpm: positive,
    /** Octaves. */
    tempo_std: positive,
    /** Seconds. */
    tempo_window: positive,
    /** Beats per minute. */
    max_tempo: positive,
    tightness: positive,
    /** Columns of a feature row. */
    features: count,
  }),
  v.check(
    ({ features, mfcc, chroma }) => features === 2 * mfcc + chroma + 2,
    'Expected 2 mfcc + chroma + 2 features',
  ),
  v.check(({ mfcc, mels }) => mfcc <= mels, 'Expected at most as many mfcc as mels'),
  v.check(
    ({ mel_fmin, mel_fmax, sample_rate }) => mel_fmin < mel_fmax && mel_fmax <= sample_rate / 2,
    'Expected mel_fmin below mel_fmax, and that at most half the sample rate',
  ),
);

/** Every constant of the music features; nothing in this folder repeats a value. */
export type AudioRecipe = Readonly<v.InferOutput<typeof schema>>;

/**
 * Checks the manifest's `audio` block.
 *
 * @throws {AppError} bad-recipe
 */
export function readRecipe(block: unknown): AudioRecipe {
  const result = v.safeParse(schema, block);
  if (result.success) return result.output;
  const [issue] = result.issues;
  throw new AppError(
    'bad-recipe',
    `The model's audio recipe cannot be used: ${v.getDotPath(issue) ?? 'audio'}: ${issue.message}.`,
    'Export the model again with this version of the project.',
  );
}

/** Feature frames of a signal of so many samples: frames are centred, the first one on sample 0. */
export function frameCount(samples: number, recipe: AudioRecipe): number {
  return 1 + Math.floor(samples / recipe.hop);
}
