import { describe, expect, it } from 'vitest';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { nearestSide, planHeading } from '../../../../web/view/camera/heading-plan';

const SECONDS = 24;
const APART = 0.8;

/** A dancer whose joints are all above one place at each moment, 30 frames a second. */
function dancer(place: (seconds: number) => readonly [x: number, z: number]): SolvedMotion {
  const frames = SECONDS * 30;
  const positions = new Float32Array(frames * JOINT_COUNT * 3);
  for (let frame = 0; frame < frames; frame++) {
    const [x, z] = place(frame / 30);
    for (let joint = 0; joint < JOINT_COUNT; joint++)
      positions.set([x, joint * 0.08, z], (frame * JOINT_COUNT + joint) * 3);
  }
  const empty = new Float32Array();
  return { fps: 30, frames, positions, offsets: empty, root: empty, rotations: empty, fitError: 0 };
}

/** Two dancers on a circle, with the angle of the line between them at each moment, radians. */
const turning = (angle: (seconds: number) => number): [SolvedMotion, SolvedMotion] => [
  dancer((s) => [(APART / 2) * Math.cos(angle(s)), (APART / 2) * Math.sin(angle(s))]),
  dancer((s) => [(-APART / 2) * Math.cos(angle(s)), (-APART / 2) * Math.sin(angle(s))]),
];

/** How far apart the two are across the picture, metres. */
const acrossAt = (angle: number, heading: number): number =>
  APART * Math.abs(Math.cos(angle) * Math.cos(heading) - Math.sin(angle) * Math.sin(heading));

describe('the plan of headings', () => {
  it.each([
    ['turn slowly', (s: number) => 0.3 * s],
    [
      'stand, change places within a second, and stand',
      (s: number) => Math.PI * Math.min(1, Math.max(0, s - 12)),
    ],
    ['sway', (s: number) => Math.sin(s)],
  ])('shows both of a couple who %s', (_, angle) => {
    const plan = planHeading(...turning(angle));
    let hidden = 0;
    let fastest = 0;
    for (let s = 0; s < SECONDS; s += 0.1) {
      if (acrossAt(angle(s), plan(s)) < 0.3) hidden += 0.1;
      fastest = Math.max(fastest, Math.abs(plan(s + 0.1) - plan(s)) / 0.1);
    }
    expect(hidden).toBeLessThan(0.6);
    expect(fastest).toBeLessThan(0.7);
  });

  it('stands still for a couple who sway or change places', () => {
    for (const angle of [
      (s: number) => 0.4 * Math.sin(2 * s),
      (s: number) => Math.PI * Math.round(s / SECONDS),
    ]) {
      const plan = planHeading(...turning(angle));
      for (let s = 0; s < SECONDS; s++) expect(Math.abs(plan(s) - plan(0))).toBeLessThan(0.3);
    }
  });

  it('is one of two opposite sides, the nearer one', () => {
    expect(nearestSide(0.2, 3)).toBeCloseTo(0.2 + Math.PI, 6);
    expect(nearestSide(0.2, 1)).toBeCloseTo(0.2, 6);
    expect(nearestSide(0.2, -9)).toBeCloseTo(0.2 - 3 * Math.PI, 6);
  });
});
