import { AppError } from '../../common/error';
import { yieldToEvents } from '../../common/yield-to-events';
import type { ModelSession } from '../load/session';
import type { Manifest } from '../manifest';
import { chunks } from './condition';

/** Latent frames that are decoded together: bounds the memory of the convolutions. */
const LATENTS_PER_CHUNK = 480;

/** What is decoded. */
export interface DecodeRequest {
  /** latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** T x 22 x 3 metres at the model's reference height. */
  readonly leader: Float32Array;
  /** streams x layers. */
  readonly gains: Float32Array;
  /** 22 bone lengths, metres. */
  readonly bones: Float32Array;
}

/** Latent frames `start` to `end`, the latter excluded. */
export interface LatentRange {
  readonly start: number;
  readonly end: number;
}

export interface DecodeOptions {
  /** Latent frames to decode; the whole clip when not given. */
  readonly range?: LatentRange | undefined;
  /** Latent frames on each side of what is decoded that are decoded with it and cut off: enough to be exact. */
  readonly overlap?: number;
  readonly signal?: AbortSignal | undefined;
}

/**
 * Decodes a dance or a part of it, chunk by chunk.
 * @returns joints of those frames, T x 22 x 3 metres at the reference height, and bone lengths T x 22 as decoded
 * @throws {AppError} `not-finite`
 * @throws the signal's reason, between two chunks
 */
export async function decodeClip(
  session: ModelSession,
  { latent, skeleton }: Manifest,
  { latents, leader, gains, bones }: DecodeRequest,
  { range, overlap = latent.receptive_field.decode, signal }: DecodeOptions = {},
): Promise<{ joints: Float32Array; lengths: Float32Array }> {
  const width = latent.layers.length * latent.channels;
  const count = skeleton.joints.length;
  const perLatent = latent.stride * count;
  const { start, end } = range ?? { start: 0, end: latents.length / width };
  const joints = new Float32Array((end - start) * perLatent * 3);
  const lengths = new Float32Array((end - start) * perLatent);
  const all = chunks(latents.length / width, LATENTS_PER_CHUNK, overlap, { start, end });
  for (const [i, chunk] of all.entries()) {
    if (i > 0) await yieldToEvents(signal);
    const output = await session.decode({
      latents: latents.subarray(chunk.inputStart * width, chunk.inputEnd * width),
      leader: leader.subarray(chunk.inputStart * perLatent * 3, chunk.inputEnd * perLatent * 3),
      gains,
      bones,
    });
    const [first, last] = [chunk.start - chunk.inputStart, chunk.end - chunk.inputStart];
    const at = chunk.start - start;
    joints.set(output.reactor.subarray(first * perLatent * 3, last * perLatent * 3), at * perLatent * 3);
    lengths.set(output.lengths.subarray(first * perLatent, last * perLatent), at * perLatent);
  }
  if (!joints.every(Number.isFinite)) {
    throw new AppError(
      'not-finite',
      'The model answered with positions that are not numbers.',
      'Lower the guidance, or choose the processor instead of WebGPU.',
    );
  }
  return { joints, lengths };
}

/** Mean length of each bone over the frames: lengths T x 22 to 22, metres. */
export function meanLengths(lengths: Float32Array, joints: number): Float32Array {
  const sums = new Float64Array(joints);
  lengths.forEach((length, i) => (sums[i % joints]! += length));
  const frames = lengths.length / joints;
  return Float32Array.from(sums, (sum) => sum / frames);
}
