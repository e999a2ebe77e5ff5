/** Settings of a 1-euro filter. */
export interface OneEuro {
  /** Cutoff frequency at rest, Hz. */
  readonly minCutoff: number;
  /** Growth of the cutoff with the speed, Hz per unit a second. */
  readonly beta: number;
}

/** Cutoff of the speed that the filter steers by, Hz. */
const SPEED_CUTOFF = 1;

const share = (cutoff: number, fps: number): number => {
  const rate = (2 * Math.PI * cutoff) / fps;
  return rate / (rate + 1);
};

/**
 * The 1-euro filter (Casiez, Roussel and Vogel 2012) on every column of a table, smoothing more the slower a column
 * moves. It runs forwards and backwards, and the mean of both is taken: a recording has no need of the lag.
 * @param values frames x columns; a new array is returned
 */
export function oneEuro(values: Float64Array, columns: number, fps: number, settings: OneEuro): Float64Array {
  const frames = values.length / columns;
  const out = new Float64Array(values.length);
  for (let column = 0; column < columns; column++) {
    for (const backwards of [false, true]) {
      let [smooth, speed] = [0, 0];
      for (let step = 0; step < frames; step++) {
        const at = (backwards ? frames - 1 - step : step) * columns + column;
        const value = values[at]!;
        if (step === 0) smooth = value;
        else {
          speed += share(SPEED_CUTOFF, fps) * ((value - smooth) * fps - speed);
          smooth += share(settings.minCutoff + settings.beta * Math.abs(speed), fps) * (value - smooth);
        }
        out[at]! += smooth / 2;
      }
    }
  }
  return out;
}
