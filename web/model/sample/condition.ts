import type { Manifest } from '../manifest';
import { yieldToEvents } from '../../common/yield-to-events';
import type { ConditionInput, ConditionRunner } from './graphs';

/** A piece of a clip in latent frames, ends excluded: its output, and the larger input that makes the output exact. */
interface Chunk {
  readonly start: number;
  readonly end: number;
  readonly inputStart: number;
  readonly inputEnd: number;
}

interface ConditionOptions {
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
}

/**
 * Cuts a clip into overlapping chunks, so that the memory a graph needs stays bounded. The graph pads the ends of its
 * input with zeros; the overlap keeps that padding out of the output.
 * @param latents latent frames of the clip
 * @param size latent frames of one chunk's output
 * @param receptiveField latent frames to each side that an output frame depends on
 * @param range latent frames to cut, the whole clip when not given
 */
export function chunks(
  latents: number,
  size: number,
  receptiveField: number,
  range: { readonly start: number; readonly end: number } = { start: 0, end: latents },
): Chunk[] {
  return Array.from({ length: Math.ceil((range.end - range.start) / size) }, (_, i) => {
    const start = range.start + i * size;
    const end = Math.min(start + size, range.end);
    return {
      start,
      end,
      inputStart: Math.max(0, start - receptiveField),
      inputEnd: Math.min(latents, end + receptiveField),
    };
  });
}

/**
 * Runs the condition graph over a whole clip, chunk by chunk.
 * @param size latent frames of one chunk
 * @returns memory, latents x memory width, and the leader's unfamiliarity, mean over the clip
 * @throws the signal's reason, between two chunks
 */
export async function conditionClip(
  run: ConditionRunner,
  input: ConditionInput,
  manifest: Manifest,
  size: number,
  { signal, onProgress }: ConditionOptions = {},
): Promise<{ readonly memory: Float32Array; readonly unfamiliarity: number }> {
  const { latent, skeleton, audio } = manifest;
  const latents = input.musicValid.length / latent.stride;
  const width = latent.memory_width;
  const memory = new Float32Array(latents * width);
  let unfamiliarity = 0;
  const all = chunks(latents, size, latent.receptive_field.condition);
  for (const [i, chunk] of all.entries()) {
    await yieldToEvents(signal);
    const output = await run({
      leader: inputOf(chunk, input.leader, latent.stride * skeleton.joints.length * 3),
      music: inputOf(chunk, input.music, latent.stride * audio.features),
      musicValid: inputOf(chunk, input.musicValid, latent.stride),
      role: input.role,
    });
    const first = chunk.start - chunk.inputStart;
    const last = chunk.end - chunk.inputStart;
    memory.set(output.memory.subarray(first * width, last * width), chunk.start * width);
    for (const value of output.unfamiliarity.subarray(first, last)) unfamiliarity += value / latents;
    onProgress?.(i + 1, all.length);
  }
  return { memory, unfamiliarity };
}

/** The input frames of a chunk. @param width numbers per latent frame */
function inputOf({ inputStart, inputEnd }: Chunk, values: Float32Array, width: number): Float32Array {
  return values.subarray(inputStart * width, inputEnd * width);
}
