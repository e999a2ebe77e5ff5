import { AppError } from '../../common/error';
import { yieldToEvents } from '../../common/yield-to-events';
import type { ModelSession } from '../load/session';
import type { Manifest } from '../manifest';
import type { DecodeInput } from './graphs';
import { chunks } from './condition';

/**
 * Latent frames that are decoded together, 85 seconds: bounds the memory of the convolutions, and how long a newer request
 * waits. Two chunks decode what lies within each other's receptive field twice.
 */
const LATENTS_PER_CHUNK = 640;

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
 * @returns joints of those frames, T x 22 x 3 metres at the reference height
 * @throws {AppError} `not-finite`
 * @throws the signal's reason, between two chunks
 */
export async function decodeClip(
  session: ModelSession,
  { latent, skeleton }: Manifest,
  { latents, leader, gains, role }: DecodeInput,
  { range, overlap = latent.receptive_field.decode, signal }: DecodeOptions = {},
): Promise<Float32Array> {
  const width = latent.layers.length * latent.channels;
  const perLatent = latent.stride * skeleton.joints.length * 3;
  const { start, end } = range ?? { start: 0, end: latents.length / width };
  const joints = new Float32Array((end - start) * perLatent);
  const all = chunks(latents.length / width, LATENTS_PER_CHUNK, overlap, { start, end });
  for (const [i, chunk] of all.entries()) {
    if (i > 0) await yieldToEvents(signal);
    const decoded = await session.decode({
      latents: latents.subarray(chunk.inputStart * width, chunk.inputEnd * width),
      leader: leader.subarray(chunk.inputStart * perLatent, chunk.inputEnd * perLatent),
      gains,
      role,
    });
    const [first, last] = [chunk.start - chunk.inputStart, chunk.end - chunk.inputStart];
    joints.set(decoded.subarray(first * perLatent, last * perLatent), (chunk.start - start) * perLatent);
  }
  if (!joints.every(Number.isFinite)) {
    throw new AppError(
      'not-finite',
      'The model answered with positions that are not numbers.',
      'Lower the guidance, or choose the processor instead of WebGPU.',
    );
  }
  return joints;
}
