/** A part of the dance, seconds. */
export interface Span {
  readonly from: number;
  readonly to: number;
}

/** Maps between time and x in the lanes: `from` is at x = 0, `to` at x = `width`. */
export interface TimeScale extends Span {
  /** CSS pixels. */
  readonly width: number;
  /** CSS pixels from the lanes' left edge; below 0 or above `width` for times that are not shown. */
  readonly x: (time: number) => number;
  /** The time at x, seconds. */
  readonly time: (x: number) => number;
}

/** Shortest span that can be shown, seconds. */
const MIN_SPAN = 1;
/** Where the playhead is placed when the lanes are scrolled to it, as a fraction of their width. */
const PLAYHEAD_FRACTION = 0.05;

/** The mapping that all lanes share. An empty span maps every time to 0. */
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
 * The span after zooming, inside the dance.
 * @param whole length of the dance, seconds
 * @param factor above 1 shows less of it, larger
 * @param around the time whose x stays the same, seconds
 */
export function zoomed({ from, to }: Span, whole: number, factor: number, around: number): Span {
  const length = Math.min(whole, Math.max(Math.min(MIN_SPAN, whole), (to - from) / factor));
  const part = to > from ? (around - from) / (to - from) : 0;
  return clampedSpan(around - part * length, length, whole);
}

/** The span moved by some seconds, inside the dance. */
export function scrolled({ from, to }: Span, whole: number, by: number): Span {
  return clampedSpan(from + by, to - from, whole);
}

/** The span itself if it contains the time; else one of the same length that begins shortly before it. */
export function spanShowing(span: Span, whole: number, time: number): Span {
  if (time >= span.from && time <= span.to) return span;
  const length = span.to - span.from;
  return clampedSpan(time - PLAYHEAD_FRACTION * length, length, whole);
}

/** How many times larger than in a view of the whole dance a span is drawn; 1 shows all of it. */
export function magnification({ from, to }: Span, whole: number): number {
  return to > from ? whole / (to - from) : 1;
}

/** Largest magnification of a dance. */
export function largestMagnification(whole: number): number {
  return Math.max(1, whole / MIN_SPAN);
}

function clampedSpan(from: number, length: number, whole: number): Span {
  const start = Math.max(0, Math.min(whole - length, from));
  return { from: start, to: Math.min(whole, start + length) };
}
