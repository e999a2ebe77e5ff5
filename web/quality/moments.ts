export type MomentKind = 'slide' | 'overlap' | 'music' | 'leader' | 'seam';

/** A moment at which a measure is past its limit. */
export interface Moment {
  readonly kind: MomentKind;
  readonly frame: number;
  /** In the measure's own unit. */
  readonly value: number;
  /** How bad that is, as on `Scale`: above 1. */
  readonly severity: number;
}

/** One measure of a dance. */
export interface Measure<Whole> {
  /** The numbers of the whole dance, as Python gives them; NaN where there is nothing to measure. */
  readonly whole: Whole;
  /** Severity per frame, one row or several, drawn above each other; NaN where there is nothing to measure. */
  readonly rows: readonly Float32Array[];
  /** A few moments past the limit, the worst first. */
  readonly worst: readonly Moment[];
}

/**
 * How values of one measure are judged, so that measures of different units can be drawn and ranked together:
 * severity is 0 at `fine`, 1 at `limit` and 2 at `bad`, linear between and beyond. `fine` may be above or below
 * `bad`.
 */
export interface Scale {
  readonly fine: number;
  readonly limit: number;
  readonly bad: number;
}

/** The severity for a value, never below 0; NaN stays NaN. */
export function severity(value: number, { fine, limit, bad }: Scale): number {
  const past = (value - limit) / (bad - limit);
  return past > 0 ? 1 + past : Math.max(0, (value - fine) / (limit - fine));
}

/** Largest number of moments of one measure. */
const MAX_MOMENTS = 3;
/** Two moments of one measure are at least this far apart, seconds. */
const MIN_DISTANCE = 1;
/** The same as a share of the dance, so that their marks do not overlap in a long one. */
const MIN_DISTANCE_SHARE = 1 / 30;

/** The few moments past the limit, the worst first. */
export function worstOf(moments: readonly Moment[]): Moment[] {
  return moments
    .filter(({ severity }) => severity > 1)
    .sort((a, b) => b.severity - a.severity)
    .slice(0, MAX_MOMENTS);
}

/** Least number of frames between two moments of one measure. */
function minDistanceFrames(frames: number, fps: number): number {
  return Math.ceil(Math.max(MIN_DISTANCE * fps, MIN_DISTANCE_SHARE * frames));
}

/**
 * The worst moments of a row: local maxima above 1 (non-maximum suppression within the least distance).
 * @param row severity per frame
 * @param value the measure's own value at a frame
 */
export function worstMoments(
  row: Float32Array,
  fps: number,
  kind: MomentKind,
  value: (frame: number) => number,
): Moment[] {
  const radius = minDistanceFrames(row.length, fps);
  const peaks: Moment[] = [];
  row.forEach((here, frame) => {
    if (!(here > 1)) return;
    for (
      let other = Math.max(0, frame - radius);
      other <= Math.min(row.length - 1, frame + radius);
      other++
    ) {
      // Of several that are equally bad the first one counts.
      if (row[other]! > here || (row[other] === here && other < frame)) return;
    }
    peaks.push({ kind, frame, value: value(frame), severity: here });
  });
  return worstOf(peaks);
}
