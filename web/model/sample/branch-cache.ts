/**
 * Bytes of latents that are kept for one leader and song: six seeds of a ten-minute dance with all their branches, or
 * fifty of a minute's. The page's memory would otherwise grow with every seed that is tried.
 */
const MAX_BYTES = 64 * 2 ** 20;

/** Sampled latents by seed and name. Those of a seed are a group: the group used longest ago is dropped first, whole. */
export class BranchCache<Name extends string> {
  readonly #groups = new Map<number, Map<Name, Float32Array>>();

  /** @param maxBytes the group used last is kept even if it is larger than this by itself */
  constructor(readonly maxBytes = MAX_BYTES) {}

  /** The arrays of a group, which becomes the one used last; empty where there is none. */
  group(seed: number): ReadonlyMap<Name, Float32Array> {
    const group = this.#groups.get(seed) ?? new Map<Name, Float32Array>();
    this.#groups.delete(seed);
    this.#groups.set(seed, group);
    return group;
  }

  /** Adds to a group, which becomes the one used last, and drops others while there is too much. */
  add(seed: number, name: Name, values: Float32Array): void {
    this.group(seed);
    this.#groups.get(seed)!.set(name, values);
    for (const oldest of this.#groups.keys()) {
      if (oldest === seed || this.bytes <= this.maxBytes) return;
      this.#groups.delete(oldest);
    }
  }

  get bytes(): number {
    const arrays = [...this.#groups.values()].flatMap((group) => [...group.values()]);
    return arrays.reduce((sum, { byteLength }) => sum + byteLength, 0);
  }
}
