/** A cache of the values that were used last; beyond so many the one used longest ago is dropped (LRU). */
export class RecentCache<K, V> {
  readonly #values = new Map<K, V>();

  constructor(readonly most: number) {}

  /** The value, which becomes the one used last. */
  get(key: K): V | undefined {
    const value = this.#values.get(key);
    if (value !== undefined) this.set(key, value);
    return value;
  }

  set(key: K, value: V): void {
    this.#values.delete(key);
    this.#values.set(key, value);
    const [oldest] = this.#values.keys();
    if (this.#values.size > this.most && oldest !== undefined) this.#values.delete(oldest);
  }
}
