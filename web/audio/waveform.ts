/** The outline of a song, for drawing: much smaller than its samples. */
export interface Waveform {
  /** Lowest and highest sample of every step, -127 to 127, as shares of the loudest sample. */
  readonly low: Int8Array;
  readonly high: Int8Array;
  /** Steps per second. */
  readonly rate: number;
  /** The largest absolute sample. */
  readonly loudest: number;
}

/** Steps per second: a column of the lane at its largest zoom is not much shorter. */
const RATE = 1000;
const FULL = 127;
/** Loudest sample up to which a song is drawn lower than the lane. */
const QUIET = 1e-3;

/**
 * @param pcm mono samples
 * @param sampleRate samples per second
 */
export function waveformOf(pcm: Float32Array, sampleRate: number): Waveform {
  const loudest = pcm.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
  const steps = Math.ceil((pcm.length / sampleRate) * RATE);
  const low = new Int8Array(steps);
  const high = new Int8Array(steps);
  for (let step = 0; step < steps; step++) {
    const end = Math.min(pcm.length, Math.ceil(((step + 1) / RATE) * sampleRate));
    let [min, max] = [0, 0];
    for (let i = Math.floor((step / RATE) * sampleRate); i < end; i++) {
      min = Math.min(min, pcm[i]!);
      max = Math.max(max, pcm[i]!);
    }
    low[step] = loudest > 0 ? Math.round((FULL * min) / loudest) : 0;
    high[step] = loudest > 0 ? Math.round((FULL * max) / loudest) : 0;
  }
  return { low, high, rate: RATE, loudest };
}

/** Lowest and highest sample of each column of a drawn waveform, as shares of the height from its middle. */
export interface Columns {
  readonly low: Float32Array;
  readonly high: Float32Array;
}

/**
 * A part of a waveform as it is drawn.
 *
 * @param span seconds of the song; outside it the waveform is flat
 * @param columns width of the drawing
 */
export function columnsOf(
  { low, high, rate, loudest }: Waveform,
  { from, to }: { readonly from: number; readonly to: number },
  columns: number,
): Columns {
  const share = Math.min(1, loudest / QUIET) / FULL;
  const lowest = new Float32Array(columns);
  const highest = new Float32Array(columns);
  const stepAt = (column: number): number => Math.floor((from + (column / columns) * (to - from)) * rate);
  for (let column = 0; column < columns; column++) {
    const first = stepAt(column);
    const end = Math.min(high.length, Math.max(first + 1, stepAt(column + 1)));
    for (let step = Math.max(0, first); step < end; step++) {
      lowest[column] = Math.min(lowest[column]!, low[step]! * share);
      highest[column] = Math.max(highest[column]!, high[step]! * share);
    }
  }
  return { low: lowest, high: highest };
}
