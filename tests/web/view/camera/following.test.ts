import { describe, expect, it } from 'vitest';
import { followByJumps, followSmoothly, type FollowInput } from '../../../../web/view/camera/following';

const input: FollowInput = {
  view: 'orbit',
  aspect: 1.6,
  offset: [0, 0],
  distance: 5,
  fitDistance: 5,
  mayZoom: true,
  turn: 0,
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

  it('follows the faster the farther they have left', () => {
    const speed = (x: number): number => followSmoothly({ ...input, offset: [x, 0] }, 1 / 60, true).shift[0];
    expect(speed(1.4) / 1).toBeGreaterThan(2 * (speed(0.5) / 0.1));
  });

  it('moves back at once, comes closer only while they dance, and keeps a distance that was chosen', () => {
    expect(followSmoothly({ ...input, fitDistance: 6 }, 0.1, false).distance).toBeGreaterThan(5);
    expect(followSmoothly({ ...input, fitDistance: 4 }, 0.1, false).distance).toBeNull();
    expect(followSmoothly({ ...input, fitDistance: 4 }, 0.1, true).distance).toBeLessThan(5);
    expect(followSmoothly({ ...input, fitDistance: 6, mayZoom: false }, 0.1, true).distance).toBeNull();
  });

  it('is not there yet while it moves back; coming closer needs no frames of its own', () => {
    expect(followSmoothly({ ...input, fitDistance: 6 }, 0.1, false).moving).toBe(true);
    expect(followSmoothly({ ...input, fitDistance: 4 }, 0.1, true).moving).toBe(false);
  });
});

describe('turning', () => {
  it('goes all the way, gently, and comes to rest', () => {
    let turn = -1.5;
    let fastest = 0;
    for (let frame = 0; frame < 200; frame++) {
      const step = followSmoothly({ ...input, turn }, 1 / 30, true);
      fastest = Math.max(fastest, Math.abs(step.turn));
      turn -= step.turn;
    }
    expect(fastest).toBeLessThan(1 / 30);
    expect(Math.abs(turn)).toBeLessThan(0.005);
    expect(followSmoothly({ ...input, turn }, 1 / 30, false).moving).toBe(false);
  });

  it('by jumps waits until one dancer is about to hide the other', () => {
    expect(followByJumps({ ...input, turn: 0.5 }).turn).toBe(0);
    expect(followByJumps({ ...input, turn: -1 }).turn).toBe(-1);
  });
});

describe('following by jumps', () => {
  it('stands still until the couple has left its place, then jumps', () => {
    for (const view of ['orbit', 'follow', 'top', 'side'] as const) {
      const near = followByJumps({ ...input, view, offset: [0.3, 0.2], fitDistance: 5.2 });
      expect(near).toEqual({ shift: [0, 0], distance: null, turn: 0, moving: false });
      const far = followByJumps({ ...input, view, offset: [0.4, 0.3], fitDistance: 5.2 });
      expect(far).toEqual({ shift: [0.4, 0.3], distance: 5.2, turn: 0, moving: false });
    }
  });

  it('moves back when they do not fit', () => {
    expect(followByJumps({ ...input, fitDistance: 6 }).distance).toBe(6);
    expect(followByJumps({ ...input, fitDistance: 6, mayZoom: false }).distance).toBeNull();
    const away = followByJumps({ ...input, offset: [1, 0], fitDistance: 6, mayZoom: false });
    expect(away).toMatchObject({ shift: [1, 0], distance: null });
    expect(followByJumps({ ...input, distance: 8 }).distance).toBe(5);
  });
});
