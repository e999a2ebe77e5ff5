/** A run of latent frames that the step graph computes together. */
export interface Block {
  readonly start: number;
  readonly length: number;
}

/**
 * Cut a clip into blocks (blockwise local context, paper 3.4).
 * @param latents length of the clip in latent frames
 * @param size latent frames of a full block
 * @returns blocks in order; the last one may be short
 */
export function partition(latents: number, size: number): Block[] {
  const count = Math.ceil(latents / size);
  return Array.from({ length: count }, (_, i) => ({
    start: i * size,
    length: Math.min(size, latents - i * size),
  }));
}

/**
 * Copy latent frames into blocks.
 * @param source latents x width
 * @returns blocks x size x width, zero where a block is short
 */
export function gather(
  source: Float32Array,
  width: number,
  blocks: readonly Block[],
  size: number,
): Float32Array {
  const out = new Float32Array(blocks.length * size * width);
  blocks.forEach(({ start, length }, i) => {
    out.set(source.subarray(start * width, (start + length) * width), i * size * width);
  });
  return out;
}

/** The reverse of `gather`: write blocks (blocks x size x width) back into `target` (latents x width). */
export function scatter(
  target: Float32Array,
  width: number,
  source: Float32Array,
  blocks: readonly Block[],
  size: number,
): void {
  blocks.forEach(({ start, length }, i) => {
    target.set(source.subarray(i * size * width, (i * size + length) * width), start * width);
  });
}

/** Blocks x size: 1 for latent frames of the clip, 0 for padding. */
export function validity(blocks: readonly Block[], size: number): Float32Array {
  const out = new Float32Array(blocks.length * size);
  blocks.forEach(({ length }, i) => out.fill(1, i * size, i * size + length));
  return out;
}
