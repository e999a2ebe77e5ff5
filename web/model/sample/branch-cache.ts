/**
 * Bytes of latents that are kept for one leader and song: six seeds of a ten-minute dance with all their branches, or
 * fifty of a minute's. The page's memory would otherwise grow with every seed that is tried.
 */
const MAX_BYTES = 64 * 2 ** 20;

/** Sampled latents by name, in groups that are dropped as a whole: the group used longest ago goes first. */
export class BranchCache<Name extends string> {
  readonly #groups = new Map<string, Map<Name, Float32Array>>();

  /** @param maxBytes the group used last is kept even if it is larger than this by itself */
  constructor(readonly maxBytes = MAX_BYTES) {}

  /** The arrays of a group, which becomes the one used last; empty where there is none. */
  group(key: string): ReadonlyMap<Name, Float32Array> {
    const group = this.#groups.get(key) ?? new Map<Name, Float32Array>();
    this.#groups.delete(key);
    this.#groups.set(key, group);
    return group;
  }

  /** Adds to a group, which becomes the one used last, and drops others while there is too much. */
  add(key: string, name: Name, values: Float32Array): void {
    this.group(key);
    this.#groups.get(key)!.set(name, values);
    for (const oldest of this.#groups.keys()) {
      if (oldest === key || this.bytes <= this.maxBytes) return;
      this.#groups.delete(oldest);
    }
  }

  get bytes(): number {
    const arrays = [...this.#groups.values()].flatMap((group) => [...group.values()]);
    return arrays.reduce((sum, { byteLength }) => sum + byteLength, 0);
  }
}
