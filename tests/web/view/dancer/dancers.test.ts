import { type MeshStandardMaterial, SkinnedMesh } from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { J } from '../../../../web/motion/skeleton/skeleton';
import { createBodyLibrary } from '../../../../web/view/body/library';
import { createCast, type Cast } from '../../../../web/view/dancer/dancers';
import { pixelPaint } from '../../../../web/view/dancer/body-material';
import { NOTHING_SHOWN } from '../../../../web/view/overlays/overlays';
import { LOOKS } from '../../../../web/view/theme';
import { randomMotion } from '../../support/skeletons';

const motions = {
  leader: randomMotion(30, 1),
  reactor: randomMotion(30, 2),
  coarse: randomMotion(30, 3),
  other: randomMotion(30, 4),
  otherCoarse: randomMotion(30, 5),
};
const PARTS = ['leader', 'reactor', 'coarse', 'other', 'otherCoarse'] as const;

describe('the cast', () => {
  let cast: Cast;
  /** Who is to be seen, in the order of `PARTS`. */
  const seen = (): boolean[] => cast.object.children.map(({ visible }) => visible);

  beforeEach(() => {
    // Node has no Worker: bodies are made here, in their own time, and none is waited for.
    vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    cast = createCast(createBodyLibrary(), pixelPaint, () => undefined);
    for (const part of PARTS) cast.setMotion(part, motions[part]);
    cast.pose(0.4);
  });
  afterEach(() => {
    cast.dispose();
    vi.restoreAllMocks();
  });

  it('shows another take as a ghost beside both, and the coarse layer when it is asked for', () => {
    cast.arrange('whole');
    expect(seen()).toEqual([true, true, false, true, false]);
    cast.setShown({ ...NOTHING_SHOWN, ghost: true });
    cast.arrange('whole');
    expect(seen()).toEqual([true, true, true, true, false]);
    expect(cast.split).toBe(false);
  });

  it('shows the leader in both halves, the reactor in the left, the other take in the right, each with its coarse layer', () => {
    cast.setOtherMode('right');
    cast.setShown({ ...NOTHING_SHOWN, ghost: true });
    expect(cast.split).toBe(true);
    const left = cast.arrange('left');
    expect(seen()).toEqual([true, true, true, false, false]);
    expect(left.map(({ role, motion }) => [role, motion])).toEqual([
      ['leader', motions.leader],
      ['reactor', motions.reactor],
    ]);
    const right = cast.arrange('right');
    expect(seen()).toEqual([true, false, false, true, true]);
    expect(right.map(({ role, motion }) => [role, motion])).toEqual([
      ['leader', motions.leader],
      ['reactor', motions.other],
    ]);
    cast.setShown(NOTHING_SHOWN);
    cast.arrange('right');
    expect(seen()).toEqual([true, false, false, true, false]);
    // The other take may have the left half as well; the reactor has the right one then.
    cast.setOtherMode('left');
    cast.arrange('left');
    expect(seen()).toEqual([true, false, false, true, false]);
    cast.arrange('right');
    expect(seen()).toEqual([true, true, false, false, false]);
    expect(cast.seen()).toEqual([cast.joints('leader'), cast.joints('reactor')]);
    cast.arrange('left');
    expect(cast.seen()).toEqual([cast.joints('leader'), cast.joints('other')]);
    cast.setMotion('other', null);
    expect(cast.split).toBe(false);
  });

  it('shows another leader beside the loaded reactor when the leader is who was made, in the colour of a leader', async () => {
    cast.setOtherMode('right');
    cast.setLook(LOOKS.dark);
    cast.setMade('leader');
    await cast.dressed();
    const right = cast.arrange('right');
    expect(seen()).toEqual([false, true, false, true, false]);
    expect(right.map(({ role, motion }) => [role, motion])).toEqual([
      ['reactor', motions.reactor],
      ['leader', motions.other],
    ]);
    const colour = (part: number): string => {
      let found = '';
      cast.object.children[part]!.traverse((object) => {
        if (object instanceof SkinnedMesh)
          found = (object.material as MeshStandardMaterial).color.getHexString();
      });
      return found;
    };
    expect(colour(3)).toBe(colour(0));
    expect(colour(3)).not.toBe(colour(1));
  });

  it('has light bodies from afar, bodies that come later too, and full ones again', async () => {
    const triangles = (): number => {
      let count = 0;
      cast.object.children[0]!.traverse((object) => {
        if (object instanceof SkinnedMesh) count = (object as SkinnedMesh).geometry.drawRange.count / 3;
      });
      return count;
    };
    cast.setFar(true);
    await cast.dressed();
    const light = triangles();
    cast.setFar(false);
    expect(light).toBeLessThan(0.6 * triangles());
    cast.setFar(true);
    expect(triangles()).toBe(light);
  });

  it('lets the leader look at the partner of each half, whichever was drawn before', () => {
    cast.setOtherMode('right');
    const gaze = (picture: 'left' | 'right'): number[] => {
      cast.arrange(picture);
      return cast.object.children[0]!.getObjectByName('head')!.quaternion.toArray();
    };
    let apart = 0;
    for (const seconds of [0, 0.1, 0.2, 0.3, 0.4]) {
      cast.pose(seconds);
      const [left, right, again] = [gaze('left'), gaze('right'), gaze('left')];
      apart = Math.max(apart, ...left.map((value, i) => Math.abs(value - right[i]!)));
      for (const [i, value] of again.entries()) expect(value).toBeCloseTo(left[i]!, 6);
    }
    expect(apart).toBeGreaterThan(0.05);
    const joints = cast.joints('leader');
    for (const i of [J.head, J.left_wrist])
      expect(joints[i * 3]!).toBeCloseTo(motions.leader.positions[(12 * 22 + i) * 3]!, 4);
  });

  it('has everybody in the picture that is measured', () => {
    const { reach } = cast.pose(0.4);
    cast.setMotion('other', null);
    const alone = cast.pose(0.4);
    const far = { ...motions.other, root: motions.other.root.map((value) => value * 4) };
    cast.setMotion('other', far);
    const wide = cast.pose(0.4);
    expect(reach).toBeGreaterThanOrEqual(alone.reach);
    expect(wide.reach).toBeGreaterThan(alone.reach + 0.5);
    // The couple itself stays where it was.
    expect([wide.x, wide.z, wide.square]).toEqual([alone.x, alone.z, alone.square]);
  });
});
