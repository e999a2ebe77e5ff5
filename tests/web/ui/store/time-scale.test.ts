import { describe, expect, it } from 'vitest';
import {
  largestMagnification,
  magnification,
  scrolled,
  spanShowing,
  timeScale,
  zoomed,
} from '../../../../web/ui/store/time-scale';

describe('time and x', () => {
  it('are inverse to each other', () => {
    const scale = timeScale({ from: 4, to: 14 }, 500);
    expect(scale.x(4)).toBe(0);
    expect(scale.x(14)).toBe(500);
    expect(scale.x(3)).toBe(-50);
    for (const time of [-2, 4, 7.3, 20]) expect(scale.time(scale.x(time))).toBeCloseTo(time, 9);
  });

  it('are finite where there is nothing to show', () => {
    expect(timeScale({ from: 0, to: 0 }, 500).x(3)).toBe(0);
    expect(timeScale({ from: 2, to: 4 }, 0).time(10)).toBe(2);
  });
});

describe('zooming', () => {
  const all = { from: 0, to: 60 };

  it('keeps the time under the pointer where it is', () => {
    const near = zoomed(all, 60, 3, 20);
    expect(near.to - near.from).toBeCloseTo(20);
    expect(timeScale(near, 900).x(20)).toBeCloseTo(timeScale(all, 900).x(20));
  });

  it('stays inside the dance and shows at least a second', () => {
    expect(zoomed({ from: 0, to: 10 }, 60, 0.5, 0)).toEqual({ from: 0, to: 20 });
    expect(zoomed({ from: 50, to: 60 }, 60, 0.01, 55)).toEqual(all);
    const nearest = zoomed(all, 60, 1e9, 60);
    expect(nearest.to - nearest.from).toBeCloseTo(1);
    expect(nearest.to).toBe(60);
    expect(zoomed({ from: 0, to: 0.4 }, 0.4, 2, 0.2)).toEqual({ from: 0, to: 0.4 });
  });

  it('has a magnification', () => {
    expect(magnification({ from: 10, to: 20 }, 60)).toBe(6);
    expect(largestMagnification(60)).toBe(60);
    expect(largestMagnification(0.5)).toBe(1);
  });
});

describe('scrolling', () => {
  it('stops at both ends', () => {
    expect(scrolled({ from: 10, to: 20 }, 60, 5)).toEqual({ from: 15, to: 25 });
    expect(scrolled({ from: 10, to: 20 }, 60, -50)).toEqual({ from: 0, to: 10 });
    expect(scrolled({ from: 10, to: 20 }, 60, 50)).toEqual({ from: 50, to: 60 });
  });

  it('scrolls to a time only when it is not shown', () => {
    const span = { from: 10, to: 20 };
    expect(spanShowing(span, 60, 19.9)).toBe(span);
    expect(spanShowing(span, 60, 20.5)).toEqual({ from: 20, to: 30 });
    expect(spanShowing(span, 60, 59)).toEqual({ from: 50, to: 60 });
    expect(spanShowing(span, 60, 0)).toEqual({ from: 0, to: 10 });
  });
});
