import { describe, expect, it } from 'vitest';
import { followByJumps, followSmoothly, type FollowInput } from '../../../../web/view/camera/following';

const input: FollowInput = {
  view: 'orbit',
  aspect: 1.6,
  offset: [0, 0],
  distance: 5,
  fitDistance: 5,
  mayZoom: true,
};

describe('following smoothly', () => {
  it('moves to a couple that has travelled, a little with every frame', () => {
    let offset: readonly [number, number] = [2, 0];
    const steps: number[] = [];
    for (let frame = 0; frame < 400; frame++) {
      const { shift } = followSmoothly({ ...input, view: 'follow', offset }, 1 / 30, true);
      steps.push(Math.hypot(...shift));
      offset = [offset[0] - shift[0], offset[1] - shift[1]];
    }
    expect(Math.max(...steps)).toBeLessThan(0.2);
    expect(offset[0]).toBeLessThan(1e-3);
    expect(followSmoothly({ ...input, view: 'follow', offset }, 1 / 30, true).moving).toBe(false);
  });

  it('stays while the couple is near the middle in the orbit view, and follows at the edge', () => {
    expect(followSmoothly({ ...input, offset: [0.3, 0] }, 0.1, true).shift).toEqual([0, 0]);
    // In a narrow picture the edge is nearer.
    expect(followSmoothly({ ...input, offset: [0.3, 0], aspect: 0.5 }, 0.1, true).shift[0]).toBeGreaterThan(
      0,
    );
    expect(followSmoothly({ ...input, offset: [0.5, 0] }, 1e6, true).shift[0]).toBeCloseTo(0.1);
  });

  it('moves back at once, comes closer only while they dance, and keeps a distance that was chosen', () => {
    expect(followSmoothly({ ...input, fitDistance: 6 }, 0.1, false).distance).toBeGreaterThan(5);
    expect(followSmoothly({ ...input, fitDistance: 4 }, 0.1, false).distance).toBeNull();
    expect(followSmoothly({ ...input, fitDistance: 4 }, 0.1, true).distance).toBeLessThan(5);
    expect(followSmoothly({ ...input, fitDistance: 6, mayZoom: false }, 0.1, true).distance).toBeNull();
  });
});

describe('following by jumps', () => {
  it('stands still until the couple has left its place, then jumps', () => {
    for (const view of ['orbit', 'follow', 'top', 'side'] as const) {
      const near = followByJumps({ ...input, view, offset: [0.3, 0.2], fitDistance: 5.2 });
      expect(near).toEqual({ shift: [0, 0], distance: null, moving: false });
      const far = followByJumps({ ...input, view, offset: [0.4, 0.3], fitDistance: 5.2 });
      expect(far).toEqual({ shift: [0.4, 0.3], distance: 5.2, moving: false });
    }
  });

  it('moves back when they do not fit', () => {
    expect(followByJumps({ ...input, fitDistance: 6 }).distance).toBe(6);
    expect(followByJumps({ ...input, fitDistance: 6, mayZoom: false }).distance).toBeNull();
    expect(followByJumps({ ...input, distance: 8 }).distance).toBe(5);
  });
});
