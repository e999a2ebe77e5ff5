/** Frames on demand: nothing is drawn while nothing moves. */
export interface Loop {
  /** Asks for a frame. */
  invalidate(): void;
  /** Leaves the next picture out, for when the page has much else to show at that moment. */
  pass(): void;
  /** Draws what waited for the last picture to be shown. */
  resume(): void;
  /** Draws now, for when waiting would show an empty canvas. */
  flush(): void;
  /** Median main-thread milliseconds of the last frames. */
  readonly frameMs: number;
  dispose(): void;
}

const KEPT = 60;
/** Longest step that easing may take, seconds: after a pause the camera goes on instead of jumping. */
const LONGEST = 0.25;

/** Milliseconds without a picture after which the stage counts as standing still. */
const REST = 200;

/** A loop that never draws: for pictures that are drawn one by one. */
export const idleLoop: Loop = {
  invalidate: () => undefined,
  pass: () => undefined,
  resume: () => undefined,
  flush: () => undefined,
  frameMs: 0,
  dispose: () => undefined,
};

/** What a loop calls. */
export interface Drawing {
  /** Draws a frame, `dt` seconds after the last one; true asks for another. */
  readonly draw: (dt: number) => boolean;
  /** Whether the last frame is on the page; until then no other is drawn. */
  readonly shown: () => boolean;
  /** A frame that was asked for can be drawn, after so many milliseconds; called before it is. */
  readonly due: (waited: number) => void;
  /** Nothing has moved for a while. */
  readonly rest: () => void;
}

export function createLoop({ draw, shown, due, rest }: Drawing): Loop {
  let request = 0;
  let asked = 0;
  let passes = false;
  /** A frame was due before the last one was shown. */
  let waits = false;
  let resting: ReturnType<typeof setTimeout> | undefined;
  let before = 0;
  let running = false;
  let disposed = false;
  const times: number[] = [];

  function frame(now: number): void {
    request = 0;
    const dt = running ? Math.min(LONGEST, Math.max(0, (now - before) / 1000)) : 1 / 60;
    before = now;
    const start = performance.now();
    clearTimeout(resting);
    running = draw(dt);
    times.push(performance.now() - start);
    if (times.length > KEPT) times.shift();
    if (running) invalidate();
    else resting = setTimeout(rest, REST);
  }
  function invalidate(): void {
    if (request !== 0 || waits || disposed) return;
    asked = performance.now();
    request = requestAnimationFrame((now) => {
      request = 0;
      if (passes) {
        passes = false;
        return invalidate();
      }
      if (shown()) drawDue(now);
      else waits = true;
    });
  }
  function drawDue(now: number): void {
    due(performance.now() - asked);
    frame(now);
  }
  return {
    invalidate,
    pass() {
      passes = request !== 0;
    },
    resume() {
      if (!waits || disposed) return;
      waits = false;
      drawDue(performance.now());
    },
    flush() {
      if (disposed) return;
      waits = false;
      if (request !== 0) cancelAnimationFrame(request);
      frame(performance.now());
    },
    get frameMs() {
      const sorted = [...times].sort((a, b) => a - b);
      return sorted[Math.floor(sorted.length / 2)] ?? 0;
    },
    dispose() {
      disposed = true;
      clearTimeout(resting);
      if (request !== 0) cancelAnimationFrame(request);
      request = 0;
    },
  };
}
