import { type MeshStandardMaterial, ShaderMaterial, SkinnedMesh } from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { J } from '../../../../web/motion/skeleton/skeleton';
import { createBodyLibrary } from '../../../../web/view/body/library';
import { Dancers } from '../../../../web/view/dancer/dancers';
import { perPixelMaterial } from '../../../../web/view/dancer/body-material';
import { NO_OVERLAYS } from '../../../../web/common/picture';
import { LOOKS } from '../../../../web/view/theme';
import { randomMotion } from '../../support/skeletons';

const motions = {
  leader: randomMotion(30, 1),
  reactor: randomMotion(30, 2),
  coarse: randomMotion(30, 3),
  other: randomMotion(30, 4),
  otherCoarse: randomMotion(30, 5),
};
const earlier = randomMotion(30, 6);
const NAMES = ['leader', 'reactor', 'coarse', 'other', 'otherCoarse'] as const;

describe('the dancers on the stage', () => {
  let dancers: Dancers;
  /** Which dancers are visible, in the order of `NAMES`. */
  const visible = (): boolean[] =>
    dancers.object.children.slice(0, NAMES.length).map(({ visible }) => visible);
  const earlierSeen = (): boolean => dancers.object.children[NAMES.length]!.visible;

  beforeEach(() => {
    // Node has no Worker: bodies are made on this thread, and most tests do not wait for them.
    vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    dancers = new Dancers(createBodyLibrary(), perPixelMaterial, () => undefined);
    for (const name of NAMES) dancers.setMotion(name, motions[name]);
    dancers.pose(0.4);
  });
  afterEach(() => {
    dancers.dispose();
    vi.restoreAllMocks();
  });

  it('shows another take as a ghost beside both, and the coarse layer when its overlay is on', () => {
    dancers.arrange('whole');
    expect(visible()).toEqual([true, true, false, true, false]);
    dancers.setOverlays({ ...NO_OVERLAYS, ghost: true });
    dancers.arrange('whole');
    expect(visible()).toEqual([true, true, true, true, false]);
    expect(dancers.split).toBe(false);
  });

  it('shows the leader in both halves, the reactor in the left, the other take in the right, each with its coarse layer', () => {
    dancers.setOtherMode('right');
    dancers.setOverlays({ ...NO_OVERLAYS, ghost: true });
    expect(dancers.split).toBe(true);
    const left = dancers.arrange('left');
    expect(visible()).toEqual([true, true, true, false, false]);
    expect(left.map(({ role, motion }) => [role, motion])).toEqual([
      ['leader', motions.leader],
      ['reactor', motions.reactor],
    ]);
    const right = dancers.arrange('right');
    expect(visible()).toEqual([true, false, false, true, true]);
    expect(right.map(({ role, motion }) => [role, motion])).toEqual([
      ['leader', motions.leader],
      ['reactor', motions.other],
    ]);
    dancers.setOverlays(NO_OVERLAYS);
    dancers.arrange('right');
    expect(visible()).toEqual([true, false, false, true, false]);
    // The other take may have the left half as well; the reactor has the right one then.
    dancers.setOtherMode('left');
    dancers.arrange('left');
    expect(visible()).toEqual([true, false, false, true, false]);
    dancers.arrange('right');
    expect(visible()).toEqual([true, true, false, false, false]);
    expect(dancers.visibleJoints()).toEqual([dancers.joints('leader'), dancers.joints('reactor')]);
    dancers.arrange('left');
    expect(dancers.visibleJoints()).toEqual([dancers.joints('leader'), dancers.joints('other')]);
    dancers.setMotion('other', null);
    expect(dancers.split).toBe(false);
  });

  it('shows another leader beside the loaded reactor when the leader was made, in the colour of a leader', async () => {
    dancers.setOtherMode('right');
    dancers.setLook(LOOKS.dark);
    dancers.setMade('leader');
    await dancers.bodiesReady();
    const right = dancers.arrange('right');
    expect(visible()).toEqual([false, true, false, true, false]);
    expect(right.map(({ role, motion }) => [role, motion])).toEqual([
      ['reactor', motions.reactor],
      ['leader', motions.other],
    ]);
    const colour = (part: number): string => {
      let found = '';
      dancers.object.children[part]!.traverse((object) => {
        if (object instanceof SkinnedMesh)
          found = (object.material as MeshStandardMaterial).color.getHexString();
      });
      return found;
    };
    expect(colour(3)).toBe(colour(0));
    expect(colour(3)).not.toBe(colour(1));
  });

  it('shows the dance before a change as a ghost, which fades out in less than half a second', async () => {
    const opacity = (): number => {
      let found = NaN;
      dancers.object.children[NAMES.length]!.traverse((object) => {
        if (object instanceof SkinnedMesh && object.material instanceof ShaderMaterial)
          found = object.material.uniforms['facing']!.value as number;
      });
      return found;
    };
    dancers.setLook(LOOKS.dark);
    const { radius } = dancers.pose(0.4);
    dancers.setMotion('earlier', { ...earlier, root: earlier.root.map((value) => value + 5) });
    await dancers.bodiesReady();
    // It moves no camera.
    expect(dancers.pose(0.4).radius).toBe(radius);
    dancers.arrange('whole');
    expect(earlierSeen()).toBe(true);
    const full = opacity();
    dancers.fadeOut('earlier');
    expect(dancers.advance(0.2)).toBe(true);
    expect(opacity()).toBeCloseTo(full / 2, 6);
    // Shown again before it has gone, it is as clear as before.
    dancers.setMotion('earlier', earlier);
    expect(opacity()).toBe(full);
    expect(dancers.advance(1)).toBe(false);
    dancers.fadeOut('earlier');
    dancers.advance(0.3);
    expect(earlierSeen()).toBe(true);
    dancers.advance(0.2);
    expect(earlierSeen()).toBe(false);
    expect(dancers.advance(0.1)).toBe(false);
    dancers.setMotion('earlier', earlier);
    expect([earlierSeen(), opacity()]).toEqual([true, full]);
    dancers.setOtherMode('right');
    dancers.arrange('left');
    expect(earlierSeen()).toBe(false);
  });

  it('goes on from the pose that is shown where a crossfade is interrupted', () => {
    const [second, third] = [randomMotion(30, 7), randomMotion(30, 8)];
    const shown = (): Float32Array => {
      dancers.pose(0.4);
      return dancers.joints('reactor').slice();
    };
    /** The farthest that a coordinate is from where it was, metres. */
    const moved = (from: Float32Array): number =>
      Math.max(...shown().map((value, i) => Math.abs(value - from[i]!)));
    const first = shown();
    dancers.setMotion('reactor', second, true);
    expect(moved(first)).toBeLessThan(1e-4);
    dancers.advance(0.1);
    const between = shown();
    expect(moved(first)).toBeGreaterThan(0.05);
    dancers.setMotion('reactor', third, true);
    expect(moved(between)).toBeLessThan(1e-4);
    dancers.advance(0.2);
    expect(moved(between)).toBeGreaterThan(0.05);
    dancers.advance(0.2);
    expect(dancers.advance(0.2)).toBe(false);
    const last = shown();
    dancers.setMotion('reactor', null);
    dancers.setMotion('reactor', third);
    expect(moved(last)).toBe(0);
  });

  it('draws low detail when told to, bodies that come later too, and full detail again', async () => {
    const triangles = (): number => {
      let count = 0;
      dancers.object.children[0]!.traverse((object) => {
        if (object instanceof SkinnedMesh) count = (object as SkinnedMesh).geometry.drawRange.count / 3;
      });
      return count;
    };
    dancers.setLowDetail(true);
    await dancers.bodiesReady();
    const light = triangles();
    dancers.setLowDetail(false);
    expect(light).toBeLessThan(0.6 * triangles());
    dancers.setLowDetail(true);
    expect(triangles()).toBe(light);
  });

  it('turns the leader to the partner of each half, whichever was drawn before', () => {
    dancers.setOtherMode('right');
    const gaze = (picture: 'left' | 'right'): number[] => {
      dancers.arrange(picture);
      return dancers.object.children[0]!.getObjectByName('head')!.quaternion.toArray();
    };
    let apart = 0;
    for (const seconds of [0, 0.1, 0.2, 0.3, 0.4]) {
      dancers.pose(seconds);
      const [left, right, again] = [gaze('left'), gaze('right'), gaze('left')];
      apart = Math.max(apart, ...left.map((value, i) => Math.abs(value - right[i]!)));
      for (const [i, value] of again.entries()) expect(value).toBeCloseTo(left[i]!, 6);
    }
    expect(apart).toBeGreaterThan(0.05);
    const joints = dancers.joints('leader');
    for (const i of [J.head, J.left_wrist])
      expect(joints[i * 3]!).toBeCloseTo(motions.leader.positions[(12 * 22 + i) * 3]!, 4);
  });

  it('measures all dancers', () => {
    const { radius } = dancers.pose(0.4);
    dancers.setMotion('other', null);
    const alone = dancers.pose(0.4);
    const far = { ...motions.other, root: motions.other.root.map((value) => value * 4) };
    dancers.setMotion('other', far);
    const wide = dancers.pose(0.4);
    expect(radius).toBeGreaterThanOrEqual(alone.radius);
    expect(wide.radius).toBeGreaterThan(alone.radius + 0.5);
    // The couple itself stays where it was.
    expect([wide.x, wide.z, wide.sideHeading]).toEqual([alone.x, alone.z, alone.sideHeading]);
  });
});
