import { describe, expect, it } from 'vitest';
import { cutAlong, glideAlong, type Seen } from '../../../../web/view/camera/following';

const seen: Seen = { view: 'orbit', aspect: 1.6, away: [0, 0], distance: 5, goal: 5, free: true };

describe('a camera that glides', () => {
  it('comes to a couple that has gone, a little with every picture', () => {
    let away: readonly [number, number] = [2, 0];
    const ways: number[] = [];
    for (let picture = 0; picture < 400; picture++) {
      const { by } = glideAlong({ ...seen, view: 'follow', away }, 1 / 30, true);
      ways.push(Math.hypot(...by));
      away = [away[0] - by[0], away[1] - by[1]];
    }
    expect(Math.max(...ways)).toBeLessThan(0.2);
    expect(away[0]).toBeLessThan(1e-3);
    expect(glideAlong({ ...seen, view: 'follow', away }, 1 / 30, true).moving).toBe(false);
  });

  it('stays while the couple strays little in the orbit view, and goes along at the edge', () => {
    expect(glideAlong({ ...seen, away: [0.3, 0] }, 0.1, true).by).toEqual([0, 0]);
    // In a narrow picture the edge is nearer.
    expect(glideAlong({ ...seen, away: [0.3, 0], aspect: 0.5 }, 0.1, true).by[0]).toBeGreaterThan(0);
    expect(glideAlong({ ...seen, away: [0.5, 0] }, 1e6, true).by[0]).toBeCloseTo(0.1);
  });

  it('steps back at once, comes closer only while they dance, and leaves a chosen distance alone', () => {
    expect(glideAlong({ ...seen, goal: 6 }, 0.1, false).distance).toBeGreaterThan(5);
    expect(glideAlong({ ...seen, goal: 4 }, 0.1, false).distance).toBeNull();
    expect(glideAlong({ ...seen, goal: 4 }, 0.1, true).distance).toBeLessThan(5);
    expect(glideAlong({ ...seen, goal: 6, free: false }, 0.1, true).distance).toBeNull();
  });
});

describe('a camera that jumps', () => {
  it('stands still until the couple has left its place, then is there at once', () => {
    for (const view of ['orbit', 'follow', 'top', 'side'] as const) {
      const near = cutAlong({ ...seen, view, away: [0.3, 0.2], goal: 5.2 });
      expect(near).toEqual({ by: [0, 0], distance: null, moving: false });
      const far = cutAlong({ ...seen, view, away: [0.4, 0.3], goal: 5.2 });
      expect(far).toEqual({ by: [0.4, 0.3], distance: 5.2, moving: false });
    }
  });

  it('stands farther away when they do not fit', () => {
    expect(cutAlong({ ...seen, goal: 6 }).distance).toBe(6);
    expect(cutAlong({ ...seen, goal: 6, free: false }).distance).toBeNull();
    expect(cutAlong({ ...seen, distance: 8 }).distance).toBe(5);
  });
});
