/**
 * Counter-based noise, the same numbers as training/diffusion/noise.py: Philox4x32-10 (Salmon et al., SC 2011) and Box-Muller.
 * A latent frame's noise depends on (seed, frame, channel) alone, so block order and clip length don't matter.
 */

const ROUNDS = 10;

/** High and low 32 bits of the product of two unsigned 32-bit numbers; doubles would lose the low bits. */
function multiply(a: number, b: number): [high: number, low: number] {
  const a0 = a & 0xffff;
  const a1 = a >>> 16;
  const b0 = b & 0xffff;
  const b1 = b >>> 16;
  const low = a0 * b0;
  const middle = a1 * b0 + (low >>> 16);
  const carried = a0 * b1 + (middle % 0x10000);
  return [
    (a1 * b1 + Math.floor(middle / 0x10000) + Math.floor(carried / 0x10000)) >>> 0,
    Math.imul(a, b) >>> 0,
  ];
}

/** Philox4x32-10: four uint32 of random bits for a counter of four uint32 under a key of two. */
export function philox(
  counter: readonly [number, number, number, number],
  key: readonly [number, number],
): [number, number, number, number] {
  let [c0, c1, c2, c3] = counter;
  let [k0, k1] = key;
  for (let round = 0; round < ROUNDS; round++) {
    const [high0, low0] = multiply(0xd2511f53, c0);
    const [high1, low1] = multiply(0xcd9e8d57, c2);
    c0 = (high1 ^ c1 ^ k0) >>> 0;
    c1 = low1;
    c2 = (high0 ^ c3 ^ k1) >>> 0;
    c3 = low0;
    k0 = (k0 + 0x9e3779b9) >>> 0;
    k1 = (k1 + 0xbb67ae85) >>> 0;
  }
  return [c0 >>> 0, c1 >>> 0, c2 >>> 0, c3 >>> 0];
}

/** Half a step above the grid: never 0, so the logarithm is finite. */
const uniform = (bits: number): number => (bits + 0.5) / 2 ** 32;

/**
 * Standard normal noise for latent frames `start` to `start + frames - 1`.
 * @param seed its lowest 32 bits count
 * @param channels layers x channels of a layer, flattened layer first
 * @returns frames x channels
 */
export function noise(seed: number, frames: number, channels: number, start = 0): Float32Array {
  const out = new Float32Array(frames * channels);
  const key = [seed >>> 0, 0] as const;
  for (let frame = 0; frame < frames; frame++) {
    for (let channel = 0; channel < channels; channel += 4) {
      const bits = philox([start + frame, channel / 4, 0, 0], key);
      for (let lane = 0; lane < 4 && channel + lane < channels; lane += 2) {
        const radius = Math.sqrt(-2 * Math.log(uniform(bits[lane as 0 | 2])));
        const angle = 2 * Math.PI * uniform(bits[(lane + 1) as 1 | 3]);
        const at = frame * channels + channel + lane;
        out[at] = radius * Math.cos(angle);
        if (channel + lane + 1 < channels) out[at + 1] = radius * Math.sin(angle);
      }
    }
  }
  return out;
}
