import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createLoop } from '../../../web/view/loop';

let waiting: FrameRequestCallback | null = null;
const tick = (now: number): void => {
  const callback = waiting;
  waiting = null;
  callback?.(now);
};

beforeEach(() => {
  waiting = null;
  vi.stubGlobal('requestAnimationFrame', (callback: FrameRequestCallback) => {
    waiting = callback;
    return 1;
  });
  vi.stubGlobal('cancelAnimationFrame', () => {
    waiting = null;
  });
});
afterEach(() => vi.unstubAllGlobals());

describe('the loop', () => {
  it('draws once for many requests and then rests', () => {
    const draw = vi.fn(() => false);
    const loop = createLoop(draw);
    expect(waiting).toBeNull();
    loop.invalidate();
    loop.invalidate();
    tick(1000);
    expect(draw).toHaveBeenCalledTimes(1);
    expect(waiting).toBeNull();
  });

  it('goes on while something moves, in steps of real time that never jump', () => {
    const steps: number[] = [];
    const loop = createLoop((dt) => steps.push(dt) < 4);
    loop.invalidate();
    for (const now of [1000, 1016, 1050, 9000, 9016]) tick(now);
    expect(steps).toHaveLength(4);
    expect(steps[1]).toBeCloseTo(0.016, 6);
    expect(steps[2]).toBeCloseTo(0.034, 6);
    expect(steps[3]).toBeCloseTo(0.25, 6);
    expect(waiting).toBeNull();
  });

  it('draws at once when told to, and never after it is disposed', () => {
    const draw = vi.fn(() => false);
    const loop = createLoop(draw);
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
