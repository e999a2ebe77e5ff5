import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createFrameLoop, type FrameCallbacks, type FrameLoop } from '../../../web/view/frame-loop';

let waiting: FrameRequestCallback | null = null;
const tick = (now: number): void => {
  const callback = waiting;
  waiting = null;
  callback?.(now);
};

/** A loop of which only some callbacks matter. */
const makeLoop = (callbacks: Partial<FrameCallbacks>): FrameLoop =>
  createFrameLoop({
    draw: () => false,
    presented: () => true,
    beforeFrame: () => undefined,
    atRest: () => undefined,
    ...callbacks,
  });

beforeEach(() => {
  waiting = null;
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'performance'] });
  vi.stubGlobal('requestAnimationFrame', (callback: FrameRequestCallback) => {
    waiting = callback;
    return 1;
  });
  vi.stubGlobal('cancelAnimationFrame', () => {
    waiting = null;
  });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe('the frame loop', () => {
  it('draws once for many requests and then rests', () => {
    const draw = vi.fn(() => false);
    const loop = makeLoop({ draw });
    expect(waiting).toBeNull();
    loop.invalidate();
    loop.invalidate();
    tick(1000);
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waiting).toBeNull();
  });

  it('goes on while something moves, in steps of real time that are never long', () => {
    const steps: number[] = [];
    const loop = makeLoop({ draw: (dt) => steps.push(dt) < 4 });
    loop.invalidate();
    for (const now of [1000, 1016, 1050, 9000, 9016]) tick(now);
    expect(steps).toHaveLength(4);
    expect(steps[1]).toBeCloseTo(0.016, 6);
    expect(steps[2]).toBeCloseTo(0.034, 6);
    expect(steps[3]).toBeCloseTo(0.25, 6);
    expect(waiting).toBeNull();
  });

  it('holds old frames until new ones come, not for long, and draws the new ones before the next hold', () => {
    const draw = vi.fn(() => true);
    const loop = makeLoop({ draw });
    loop.invalidate();
    tick(0);
    loop.hold();
    vi.advanceTimersByTime(60);
    tick(60);
    expect(draw).toHaveBeenCalledTimes(1);
    loop.release();
    loop.hold();
    tick(64);
    expect(draw).toHaveBeenCalledTimes(2);
    vi.advanceTimersByTime(90);
    tick(154);
    expect(draw).toHaveBeenCalledTimes(2);
    vi.advanceTimersByTime(20);
    tick(174);
    expect(draw).toHaveBeenCalledTimes(3);
  });

  it('says how long a frame waited, before it is drawn', () => {
    const calls: (string | number)[] = [];
    const loop = makeLoop({
      draw: () => calls.push('draw') < 0,
      beforeFrame: (waited) => calls.push(waited),
    });
    loop.invalidate();
    vi.advanceTimersByTime(40);
    loop.invalidate();
    vi.advanceTimersByTime(30);
    tick(1000);
    expect(calls).toEqual([70, 'draw']);
    // A frame that is drawn at once has not waited.
    loop.flush();
    expect(calls).toEqual([70, 'draw', 'draw']);
  });

  it('draws no frame before the last one is presented, and then at once', () => {
    let presented = false;
    const waited: number[] = [];
    const draw = vi.fn(() => false);
    const loop = makeLoop({ draw, presented: () => presented, beforeFrame: (ms) => waited.push(ms) });
    loop.resume();
    loop.invalidate();
    vi.advanceTimersByTime(10);
    tick(1000);
    loop.invalidate();
    expect(waiting).toBeNull();
    expect(draw).not.toHaveBeenCalled();
    vi.advanceTimersByTime(20);
    presented = true;
    loop.resume();
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waited).toEqual([30]);
    loop.resume();
    expect(draw).toHaveBeenCalledTimes(1);
  });

  it('delays one frame when told to, and only one that was asked for', () => {
    const draw = vi.fn(() => false);
    const loop = makeLoop({ draw });
    loop.delay();
    loop.invalidate();
    loop.delay();
    tick(1000);
    expect(draw).not.toHaveBeenCalled();
    tick(1016);
    expect(draw).toHaveBeenCalledTimes(1);
    loop.delay();
    loop.invalidate();
    tick(1032);
    expect(draw).toHaveBeenCalledTimes(2);
  });

  it('reports once that it is at rest, a while after the last frame', () => {
    const atRest = vi.fn();
    const loop = makeLoop({ atRest });
    loop.invalidate();
    tick(1000);
    vi.advanceTimersByTime(150);
    loop.flush();
    vi.advanceTimersByTime(150);
    expect(atRest).not.toHaveBeenCalled();
    vi.advanceTimersByTime(1000);
    expect(atRest).toHaveBeenCalledTimes(1);
  });

  it('draws at once when told to', () => {
    const draw = vi.fn(() => false);
    const loop = makeLoop({ draw });
    loop.invalidate();
    loop.flush();
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waiting).toBeNull();
  });
});
