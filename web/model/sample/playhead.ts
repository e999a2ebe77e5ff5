/**
 * The moment on view, as it moves on while the dance plays: the worker may begin later than it was asked, and the part
 * that it makes first is to be around what is on view then.
 */
export interface Playhead {
  /** Motion frame at the time `at`. */
  readonly frame: number;
  /** Seconds since 1970. */
  readonly at: number;
  /** Motion frames a second; 0 while the dance does not play. */
  readonly rate: number;
}

/** Seconds since 1970 by a clock that never goes back, the same on the page and in its workers. */
export function secondsNow(): number {
  return (performance.timeOrigin + performance.now()) / 1000;
}

/** The motion frame on view at a time in seconds since 1970; beyond the end of the dance where that was passed. */
export function frameAt({ frame, at, rate }: Playhead, now: number): number {
  return frame + rate * (now - at);
}
