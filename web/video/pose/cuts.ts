import { type Grey, halved } from './grey';

/** Least difference of two pictures between which there may be a cut, and how many times it is that of others. */
const LEAST = 0.3;
const RATIO = 4;
/** How far those others are, seconds before and after: a camera that pans and lamps that flash change them, too. */
const REACH = 0.4;
/** Deviation of the grey values below which a picture shows nothing, such as a black one. */
const BLANK = 0.02;

/** Finds the cuts of a video: pictures that differ from the one before much more than those around them. */
export class CutFinder {
  #before: Float32Array | null = null;
  readonly #times: number[] = [];
  readonly #differences: number[] = [];

  /**
   * Takes the next picture; its sides are multiples of four.
   * @param time seconds, ascending
   * @returns whether it may be the first one after a cut, by those before it
   */
  next(picture: Grey, time: number): boolean {
    // Dancers and cameras move what is small.
    const values = standardised(halved(halved(picture)));
    if (!values) return false;
    this.#differences.push(this.#before ? 1 - product(this.#before, values) : 0);
    this.#times.push(time);
    this.#before = values;
    return this.#isCut(this.#times.length - 1);
  }

  /** Times of the first pictures after a cut, seconds. */
  get times(): number[] {
    return this.#times.filter((_, row) => this.#isCut(row));
  }

  #isCut(row: number): boolean {
    const [times, differences] = [this.#times, this.#differences];
    const own = differences[row]!;
    if (own < LEAST) return false;
    for (const step of [-1, 1])
      for (let other = row + step; Math.abs(times[other]! - times[row]!) <= REACH; other += step)
        if (RATIO * differences[other]! >= own) return false;
    return true;
  }
}

/** Grey values less their mean, over the root of the sum of their squares; null for a picture that shows nothing. */
function standardised({ values }: Grey): Float32Array | null {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const rest = values.map((value) => value - mean);
  const size = Math.sqrt(product(rest, rest));
  return size < BLANK * Math.sqrt(values.length) ? null : rest.map((value) => value / size);
}

/** Sum of the products; of standardised pictures their correlation, which does not change with the brightness. */
function product(a: Float32Array, b: Float32Array): number {
  return a.reduce((sum, value, i) => sum + value * b[i]!, 0);
}
