import { describe, expect, it } from 'vitest';
import type { Mesh } from 'three';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { headingOf } from '../../../../web/motion/skeleton/heading';
import { nearHandPairs } from '../../../../web/view/overlays/hand-pairs';
import type { Figure } from '../../../../web/view/overlays/overlay';
import { NO_OVERLAYS } from '../../../../web/common/picture';
import { createOverlays } from '../../../../web/view/overlays/overlays';
import { contactOpacity, footContactsOf } from '../../../../web/view/overlays/contact-fade';
import { endEffectorAt, END_EFFECTORS, endEffectorTracks } from '../../../../web/view/overlays/end-effectors';
import { createTrails, TRAIL_SECONDS } from '../../../../web/view/overlays/trails';
import { LOOKS } from '../../../../web/view/theme';
import { madeStander } from '../../support/made-stander';
import { randomMotion } from '../../support/skeletons';

/** Joints at the origin except those given, metres. */
function joints(given: Partial<Record<keyof typeof J, readonly [number, number, number]>>): Float32Array {
  const all = new Float32Array(JOINT_COUNT * 3);
  for (const [name, place] of Object.entries(given)) all.set(place, J[name as keyof typeof J] * 3);
  return all;
}

describe('the heading of a dancer', () => {
  it.each([0, 0.6, 2, -2.5])('is %d when they have turned by as much from +z', (turn) => {
    const [x, z] = [Math.cos(turn), -Math.sin(turn)];
    const turned = joints({
      left_hip: [0.1 * x, 1, 0.1 * z],
      right_hip: [-0.1 * x, 1, -0.1 * z],
      left_shoulder: [0.2 * x, 1.4, 0.2 * z],
      right_shoulder: [-0.2 * x, 1.4, -0.2 * z],
    });
    expect(headingOf(turned)).toBeCloseTo(turn, 6);
  });
});

describe('pairs of near hands', () => {
  const leader = joints({ left_wrist: [0, 1, 0], right_wrist: [0, 1, 0.5] });

  it('are the nearest pair first, and no hand twice', () => {
    const reactor = joints({ left_wrist: [0.3, 1, 0.45], right_wrist: [0.1, 1, 0.05] });
    const found = nearHandPairs(leader, reactor);
    expect(found.map((pair) => [pair.leader, pair.reactor])).toEqual([
      [J.left_wrist, J.right_wrist],
      [J.right_wrist, J.left_wrist],
    ]);
    expect(found[0]?.distance).toBeCloseTo(Math.hypot(0.1, 0.05), 6);
    expect(found.map(({ opacity }) => opacity)).toEqual([1, 1]);
  });

  it('are not both at one hand that is near to two', () => {
    const both = joints({ left_wrist: [0, 1, 0], right_wrist: [0.1, 1, 0] });
    const reactor = joints({ left_wrist: [0, 1, 0], right_wrist: [0.5, 1, 0] });
    expect(nearHandPairs(both, reactor).map((pair) => [pair.leader, pair.reactor])).toEqual([
      [J.left_wrist, J.left_wrist],
      [J.right_wrist, J.right_wrist],
    ]);
  });

  it('fade as they part and are gone beyond a distance', () => {
    const at = (gap: number) =>
      nearHandPairs(leader, joints({ left_wrist: [gap, 1, 0], right_wrist: [9, 1, 0] }));
    expect(at(0.49)[0]?.opacity).toBe(1);
    const fading = at(0.56)[0]?.opacity ?? 0;
    expect(fading).toBeGreaterThan(0.2);
    expect(fading).toBeLessThan(0.8);
    expect(at(0.63)).toEqual([]);
  });
});

describe('contact rings', () => {
  it('fade in at the start of a contact, stay during it and fade out after its end', () => {
    const stretches = [
      { first: 30, last: 60 },
      { first: 90, last: 120 },
    ];
    const at = (seconds: number): number => contactOpacity(stretches, 30, seconds);
    expect(at(0.99)).toBe(0);
    expect(at(1.04)).toBeCloseTo(0.5, 5);
    expect(at(1.5)).toBe(1);
    expect(at(2)).toBe(1);
    expect(at(2.1)).toBeCloseTo(0.5, 5);
    expect(at(2.3)).toBe(0);
    expect(at(3.5)).toBe(1);
  });

  it('are visible for feet that stand', () => {
    const motion = madeStander({ frames: 90, path: () => [0, 0] });
    for (const foot of footContactsOf(motion)) expect(contactOpacity(foot, 30, 1.5)).toBe(1);
  });
});

describe('trails', () => {
  const motion = randomMotion(60, 5);

  it('follow the feet exactly and the hands 9 cm beyond the wrists', () => {
    const tracks = endEffectorTracks(motion);
    const place = { x: 0, y: 0, z: 0 };
    const joint = (index: number, frame: number) =>
      [0, 1, 2].map((axis) => motion.positions[(frame * JOINT_COUNT + index) * 3 + axis]!);
    endEffectorAt(tracks, 3, 17, place);
    expect([place.x, place.y, place.z]).toEqual(
      joint(J.right_foot, 17).map((v) => expect.closeTo(v, 5) as unknown),
    );
    endEffectorAt(tracks, 0, 17, place);
    const [wrist, elbow] = [joint(J.left_wrist, 17), joint(J.left_elbow, 17)];
    expect(Math.hypot(place.x - wrist[0]!, place.y - wrist[1]!, place.z - wrist[2]!)).toBeCloseTo(0.09, 5);
    const beyond = Math.hypot(place.x - elbow[0]!, place.y - elbow[1]!, place.z - elbow[2]!);
    expect(beyond).toBeGreaterThan(Math.hypot(...wrist.map((v, axis) => v - elbow[axis]!)));
    // Held at the ends of the dance.
    endEffectorAt(tracks, 3, 900, place);
    expect([place.x, place.y, place.z]).toEqual(
      joint(J.right_foot, 59).map((v) => expect.closeTo(v, 5) as unknown),
    );
  });

  it('start at the start of the dance and are no longer than their duration', () => {
    const trails = createTrails();
    trails.setLook(LOOKS.dark);
    const figure: Figure = { role: 'reactor', motion, joints: motion.positions.slice(0, JOINT_COUNT * 3) };
    const triangles = (seconds: number): number => {
      trails.update([figure], seconds);
      return (trails.object as Mesh).geometry.drawRange.count / 3;
    };
    const [start, early, late, later] = [0.1, 0.7, 1.7, 1.9].map(triangles) as [
      number,
      number,
      number,
      number,
    ];
    expect(start).toBeLessThan(early);
    expect(early).toBeLessThan(late);
    expect(later).toBeCloseTo(late, -1);
    expect(late).toBeLessThanOrEqual(END_EFFECTORS * 2 * (TRAIL_SECONDS * 60 + 2));
  });

  it('are the same for a moment whatever was drawn before', () => {
    const trails = createTrails();
    trails.setLook(LOOKS.light);
    const figure: Figure = { role: 'leader', motion, joints: motion.positions.slice(0, JOINT_COUNT * 3) };
    const { geometry } = trails.object as Mesh;
    trails.update([figure], 1.2);
    const count = geometry.drawRange.count;
    const before = geometry.getAttribute('position').array.slice();
    trails.update([figure], 0.3);
    trails.update([figure], 1.2);
    expect(geometry.drawRange.count).toBe(count);
    expect(geometry.getAttribute('position').array).toEqual(before);
  });
});

describe('the overlays', () => {
  it('are in the scene only while they are switched on', () => {
    const overlays = createOverlays();
    overlays.setLook(LOOKS.dark);
    const motion = randomMotion(30, 9);
    const figure: Figure = { role: 'leader', motion, joints: motion.positions.slice(0, JOINT_COUNT * 3) };
    expect(overlays.object.children).toHaveLength(0);
    overlays.setVisible({
      skeleton: true,
      trails: true,
      contacts: true,
      facing: true,
      hands: true,
      ghost: true,
    });
    expect(overlays.object.children).toHaveLength(5);
    // One dancer, two, none.
    for (const figures of [[figure], [figure, { ...figure, role: 'reactor' as const }], []])
      overlays.update(figures, 0.5);
    overlays.setVisible({ ...NO_OVERLAYS, facing: true });
    expect(overlays.object.children).toHaveLength(1);
    overlays.dispose();
  });
});
