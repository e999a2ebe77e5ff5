import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createLoop, type Drawing, type Loop } from '../../../web/view/frame-loop';

let waiting: FrameRequestCallback | null = null;
const tick = (now: number): void => {
  const callback = waiting;
  waiting = null;
  callback?.(now);
};

/** A loop of which only some calls matter. */
const looping = (drawing: Partial<Drawing>): Loop =>
  createLoop({
    draw: () => false,
    shown: () => true,
    due: () => undefined,
    rest: () => undefined,
    ...drawing,
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

describe('the loop', () => {
  it('draws once for many requests and then rests', () => {
    const draw = vi.fn(() => false);
    const loop = looping({ draw });
    expect(waiting).toBeNull();
    loop.invalidate();
    loop.invalidate();
    tick(1000);
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waiting).toBeNull();
  });

  it('goes on while something moves, in steps of real time that never jump', () => {
    const steps: number[] = [];
    const loop = looping({ draw: (dt) => steps.push(dt) < 4 });
    loop.invalidate();
    for (const now of [1000, 1016, 1050, 9000, 9016]) tick(now);
    expect(steps).toHaveLength(4);
    expect(steps[1]).toBeCloseTo(0.016, 6);
    expect(steps[2]).toBeCloseTo(0.034, 6);
    expect(steps[3]).toBeCloseTo(0.25, 6);
    expect(waiting).toBeNull();
  });

  it('says how long a picture was waited for, before it is drawn', () => {
    const calls: (string | number)[] = [];
    const loop = looping({
      draw: () => calls.push('draw') < 0,
      due: (waited) => calls.push(waited),
    });
    loop.invalidate();
    vi.advanceTimersByTime(40);
    loop.invalidate();
    vi.advanceTimersByTime(30);
    tick(1000);
    expect(calls).toEqual([70, 'draw']);
    // What is drawn at once was not waited for.
    loop.flush();
    expect(calls).toEqual([70, 'draw', 'draw']);
  });

  it('draws no picture before the last one is shown, and then at once', () => {
    let shown = false;
    const waited: number[] = [];
    const draw = vi.fn(() => false);
    const loop = looping({ draw, shown: () => shown, due: (ms) => waited.push(ms) });
    loop.resume();
    loop.invalidate();
    vi.advanceTimersByTime(10);
    tick(1000);
    loop.invalidate();
    expect(waiting).toBeNull();
    expect(draw).not.toHaveBeenCalled();
    vi.advanceTimersByTime(20);
    shown = true;
    loop.resume();
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waited).toEqual([30]);
    loop.resume();
    expect(draw).toHaveBeenCalledTimes(1);
  });

  it('leaves one picture out when told to, and only one that is on its way', () => {
    const draw = vi.fn(() => false);
    const loop = looping({ draw });
    loop.pass();
    loop.invalidate();
    loop.pass();
    tick(1000);
    expect(draw).not.toHaveBeenCalled();
    tick(1016);
    expect(draw).toHaveBeenCalledTimes(1);
    loop.pass();
    loop.invalidate();
    tick(1032);
    expect(draw).toHaveBeenCalledTimes(2);
  });

  it('rests once, a while after the last picture', () => {
    const rest = vi.fn();
    const loop = looping({ rest });
    loop.invalidate();
    tick(1000);
    vi.advanceTimersByTime(150);
    loop.flush();
    vi.advanceTimersByTime(150);
    expect(rest).not.toHaveBeenCalled();
    vi.advanceTimersByTime(1000);
    expect(rest).toHaveBeenCalledTimes(1);
    loop.flush();
    loop.dispose();
    vi.advanceTimersByTime(1000);
    expect(rest).toHaveBeenCalledTimes(1);
  });

  it('draws at once when told to, and never after it is disposed', () => {
    const draw = vi.fn(() => false);
    const loop = looping({ draw });
    loop.invalidate();
    loop.flush();
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waiting).toBeNull();
    loop.dispose();
    loop.invalidate();
    loop.flush();
    expect(waiting).toBeNull();
    expect(draw).toHaveBeenCalledTimes(1);
  });
});
