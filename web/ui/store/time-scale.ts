/** A stretch of the dance, seconds. */
export interface Span {
  readonly from: number;
  readonly to: number;
}

/** Time and place in the lanes: `from` is at x = 0, `to` at x = `width`. */
export interface TimeScale extends Span {
  /** CSS pixels. */
  readonly width: number;
  /** Place of a time, CSS pixels from the lanes' left edge; outside the picture it is below 0 or above `width`. */
  readonly x: (time: number) => number;
  /** Time of a place. */
  readonly time: (x: number) => number;
}

/** Shortest stretch that can be looked at, seconds. */
const SHORTEST_SPAN = 1;
/** Where the playhead lands when the picture is moved to it, as a part of the picture. */
const LANDING_FRACTION = 0.05;

/** The mapping of all lanes. An empty stretch maps every time to 0. */
export function timeScale({ from, to }: Span, width: number): TimeScale {
  const seconds = to - from;
  return {
    from,
    to,
    width,
    x: (time) => (seconds > 0 ? ((time - from) / seconds) * width : 0),
    time: (x) => (width > 0 ? from + (x / width) * seconds : from),
  };
}

/**
 * The stretch after zooming, inside the dance.
 * @param whole length of the dance, seconds
 * @param factor above 1 shows less of it, larger
 * @param around the time that stays where it is
 */
export function zoomed({ from, to }: Span, whole: number, factor: number, around: number): Span {
  const length = Math.min(whole, Math.max(Math.min(SHORTEST_SPAN, whole), (to - from) / factor));
  const part = to > from ? (around - from) / (to - from) : 0;
  return clampedSpan(around - part * length, length, whole);
}

/** The stretch moved by some seconds, inside the dance. */
export function scrolled({ from, to }: Span, whole: number, by: number): Span {
  return clampedSpan(from + by, to - from, whole);
}

/** The stretch itself if it shows the time; else one as long that begins shortly before it. */
export function spanShowing(span: Span, whole: number, time: number): Span {
  if (time >= span.from && time <= span.to) return span;
  const length = span.to - span.from;
  return clampedSpan(time - LANDING_FRACTION * length, length, whole);
}

/** How many times larger than the whole dance the stretch is drawn; 1 shows all of it. */
export function magnification({ from, to }: Span, whole: number): number {
  return to > from ? whole / (to - from) : 1;
}

/** Largest magnification of a dance. */
export function largestMagnification(whole: number): number {
  return Math.max(1, whole / SHORTEST_SPAN);
}

function clampedSpan(from: number, length: number, whole: number): Span {
  const start = Math.max(0, Math.min(whole - length, from));
  return { from: start, to: Math.min(whole, start + length) };
}
