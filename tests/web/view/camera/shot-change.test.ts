import { describe, expect, it } from 'vitest';
import { gestureBetween, shotBetween } from '../../../../web/view/camera/shot-change';

const from = { target: [0, 0.84, 0], distance: 5, heading: 0.2, elevation: 0.1 } as const;
const to = { target: [1, 1, -1], distance: 3, heading: 1, elevation: 0.2 } as const;

describe('a move between two shots', () => {
  it('begins at one, ends at the other, and is in the middle after half of the time', () => {
    expect(shotBetween(from, to, 0)).toEqual(from);
    expect(shotBetween(from, to, 1)).toEqual(to);
    const half = shotBetween(from, to, 0.5);
    expect(half.distance).toBeCloseTo(4, 6);
    expect(half.target[0]).toBeCloseTo(0.5, 6);
    expect(shotBetween(from, to, 0.1).distance).toBeGreaterThan(4.95);
  });
});

describe('a gesture', () => {
  it('that zooms to the pointer is no drag, turning and panning are', () => {
    const zoom = { ...from, distance: 4, target: [0.2, 0.9, 0] } as const;
    expect(gestureBetween(from, zoom)).toEqual({ zoomed: true, dragged: false });
    expect(gestureBetween(from, { ...from, heading: 0.4 })).toEqual({ zoomed: false, dragged: true });
    expect(gestureBetween(from, { ...from, target: [0.1, 0.84, 0] })).toEqual({
      zoomed: false,
      dragged: true,
    });
    expect(gestureBetween(from, { ...zoom, elevation: 0.4 })).toEqual({ zoomed: true, dragged: true });
    expect(gestureBetween(from, from)).toEqual({ zoomed: false, dragged: false });
  });
});
