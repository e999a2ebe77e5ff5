/** Frames on demand: nothing is drawn while nothing moves. */
export interface FrameLoop {
  /** Asks for a frame. */
  invalidate(): void;
  /** Delays the frame that was asked for by one, for when the page has much else to show at that moment. */
  delay(): void;
  /** Draws no more frames for a moment, as new ones are expected: until `release`, at most `HOLD_MS`. */
  hold(): void;
  /** Ends a hold. The next frame shows something new and is drawn even if another hold begins before. */
  release(): void;
  /** Draws the frame that waited for the last one to be presented. */
  resume(): void;
  /** Draws now, for when waiting would show an empty canvas. */
  flush(): void;
}

/** Longest step between two frames, seconds: after a pause the camera goes on instead of jumping. */
const MAX_STEP = 0.25;
/** Longest time in which no frame is drawn because new ones are expected, milliseconds. */
const HOLD_MS = 100;
/** Time without a frame after which the stage is at rest, milliseconds. */
const REST_MS = 200;

/** A loop that never draws: for pictures that are drawn one by one. */
export const idleLoop: FrameLoop = {
  invalidate: () => undefined,
  delay: () => undefined,
  hold: () => undefined,
  release: () => undefined,
  resume: () => undefined,
  flush: () => undefined,
};

/** What a loop calls. */
export interface FrameCallbacks {
  /** Draws a frame, `dt` seconds after the last one; true asks for another. */
  readonly draw: (dt: number) => boolean;
  /** Whether the last frame is on the page; until then no other is drawn. */
  readonly presented: () => boolean;
  /** Called before a frame that was asked for `waitedMs` milliseconds ago is drawn. */
  readonly beforeFrame: (waitedMs: number) => void;
  /** Called when no frame has been drawn for a while. */
  readonly atRest: () => void;
}

/** Whether frames are held back; see `FrameLoop.hold` and `release`. */
function createHold(): Record<'begin' | 'end' | 'drawn', () => void> & { readonly holds: boolean } {
  let until = 0;
  /** Whether the next frame shows what was waited for. */
  let awaited = false;
  return {
    begin: () => {
      until = performance.now() + HOLD_MS;
    },
    end: () => {
      until = 0;
      awaited = true;
    },
    drawn: () => {
      awaited = false;
    },
    get holds() {
      return !awaited && performance.now() < until;
    },
  };
}

export function createFrameLoop({ draw, presented, beforeFrame, atRest }: FrameCallbacks): FrameLoop {
  let request = 0;
  let askedAt = 0;
  let delayed = false;
  const hold = createHold();
  /** Whether a frame could have been drawn before the last one was presented. */
  let waiting = false;
  let restTimer: ReturnType<typeof setTimeout> | undefined;
  let lastFrameAt = 0;
  let running = false;

  function frame(now: number): void {
    request = 0;
    const dt = running ? Math.min(MAX_STEP, Math.max(0, (now - lastFrameAt) / 1000)) : 1 / 60;
    lastFrameAt = now;
    hold.drawn();
    clearTimeout(restTimer);
    running = draw(dt);
    if (running) invalidate();
    else restTimer = setTimeout(atRest, REST_MS);
  }
  function invalidate(): void {
    if (request !== 0 || waiting) return;
    askedAt = performance.now();
    request = requestAnimationFrame((now) => {
      request = 0;
      if (delayed) {
        delayed = false;
        return invalidate();
      }
      if (presented()) drawAsked(now);
      else waiting = true;
    });
  }
  function drawAsked(now: number): void {
    if (hold.holds) return invalidate();
    beforeFrame(performance.now() - askedAt);
    frame(now);
  }
  return {
    invalidate,
    delay() {
      delayed = request !== 0;
    },
    hold: hold.begin,
    release: hold.end,
    resume() {
      if (!waiting) return;
      waiting = false;
      drawAsked(performance.now());
    },
    flush() {
      waiting = false;
      if (request !== 0) cancelAnimationFrame(request);
      frame(performance.now());
    },
  };
}
