import type { Manifest } from '../manifest';
import { yieldToEvents } from '../../common/yield-to-events';

/** A piece of a clip: latent frames `start` to `end` are wanted, `from` to `to` must be given for an exact result. */
export interface Chunk {
  readonly start: number;
  readonly end: number;
  readonly from: number;
  readonly to: number;
}

/**
 * Cut a clip for a graph that looks `reach` latent frames to each side, so that memory stays bounded.
 * The graph pads at the ends of what it is given; the extra frames keep that padding out of the wanted ones.
 */
export function chunks(latents: number, size: number, reach: number): Chunk[] {
  return Array.from({ length: Math.ceil(latents / size) }, (_, i) => {
    const start = i * size;
    const end = Math.min(start + size, latents);
    return { start, end, from: Math.max(0, start - reach), to: Math.min(latents, end + reach) };
  });
}

/** Inputs of the condition graph, T a multiple of the latent stride. */
export interface ConditionInput {
  /** T x 22 x 3, metres at the model's reference height. */
  readonly leader: Float32Array;
  /** T x features. */
  readonly music: Float32Array;
  /** T, 1 where there is a song. */
  readonly musicValid: Float32Array;
  /** 0: the reactor's part is wanted; 1: the leader's. */
  readonly role: number;
}

/** Inputs of the decode graph. */
export interface DecodeInput {
  /** latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  readonly leader: Float32Array;
  /** One multiplier per residual layer: 1 to decode it, 0 to leave it out. */
  readonly layers: Float32Array;
}

/** Returns latents x memory width. */
export type ConditionRunner = (input: ConditionInput) => Promise<Float32Array>;
/** Returns T x 22 x 3 metres. Takes a clip in one piece: bones have their mean length over all of it. */
export type DecodeRunner = (input: DecodeInput) => Promise<Float32Array>;

interface Pieces {
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
}

/** Frames of `values` (frames x width) that belong to latent frames `from` to `to`. */
function cut(values: Float32Array, chunk: Chunk, width: number): Float32Array {
  return values.subarray(chunk.from * width, chunk.to * width);
}

/** Memory of a whole clip (latents x memory width), at most `size` latent frames at a time. */
export async function conditionClip(
  run: ConditionRunner,
  input: ConditionInput,
  manifest: Manifest,
  size: number,
  { signal, onProgress }: Pieces = {},
): Promise<Float32Array> {
  const { latent, skeleton, audio } = manifest;
  const latents = input.musicValid.length / latent.stride;
  const width = latent.memory_width;
  const memory = new Float32Array(latents * width);
  const plan = chunks(latents, size, latent.receptive_field.condition);
  for (const [i, chunk] of plan.entries()) {
    await yieldToEvents(signal);
    const result = await run({
      leader: cut(input.leader, chunk, latent.stride * skeleton.joints.length * 3),
      music: cut(input.music, chunk, latent.stride * audio.features),
      musicValid: cut(input.musicValid, chunk, latent.stride),
      role: input.role,
    });
    const skip = chunk.start - chunk.from;
    memory.set(result.subarray(skip * width, (skip + chunk.end - chunk.start) * width), chunk.start * width);
    onProgress?.(i + 1, plan.length);
  }
  return memory;
}
