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
  #before: Grey | null = null;
  readonly #times: number[] = [];
  readonly #differences: number[] = [];

  /**
   * Takes the next picture; its sides are multiples of four.
   * @param time seconds, ascending
   * @returns whether it may be the first one after a cut, by those before it
   */
  next(picture: Grey, time: number): boolean {
    // Dancers and cameras move what is small.
    const small = halved(halved(picture));
    if (deviation(small.values) < BLANK) return false;
    this.#differences.push(this.#before ? difference(this.#before, small) : 0);
    this.#times.push(time);
    this.#before = small;
    return this.#isCut(this.#times.length - 1);
  }

  /** Times of the first pictures after a cut, seconds. */
  get times(): number[] {
    return this.#times.filter((_, row) => this.#isCut(row));
  }

  #isCut(row: number): boolean {
    const [times, changes] = [this.#times, this.#differences];
    const change = changes[row]!;
    if (change < LEAST) return false;
    const isCalm = (other: number): boolean => RATIO * changes[other]! < change;
    for (let other = row - 1; other >= 0 && times[row]! - times[other]! <= REACH; other--)
      if (!isCalm(other)) return false;
    for (let other = row + 1; other < times.length && times[other]! - times[row]! <= REACH; other++)
      if (!isCalm(other)) return false;
    return true;
  }
}

/** One minus the correlation of the grey values, which does not change with their brightness. */
function difference(a: Grey, b: Grey): number {
  const [meanA, meanB] = [mean(a.values), mean(b.values)];
  const product = a.values.reduce((sum, value, i) => sum + (value - meanA) * (b.values[i]! - meanB), 0);
  return 1 - product / (a.values.length * deviation(a.values) * deviation(b.values));
}

const mean = (values: Float32Array): number => values.reduce((sum, value) => sum + value, 0) / values.length;

function deviation(values: Float32Array): number {
  const middle = mean(values);
  return Math.sqrt(mean(values.map((value) => (value - middle) ** 2)));
}
