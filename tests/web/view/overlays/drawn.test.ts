/** What the overlays hand to the graphics card. */
import { Color, type InstancedMesh, Matrix4, type Mesh, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { headingOf } from '../../../../web/motion/skeleton/heading';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { createContactRings } from '../../../../web/view/overlays/contact-rings';
import { createFacing } from '../../../../web/view/overlays/facing';
import { createHandLinks } from '../../../../web/view/overlays/hand-links';
import type { Figure } from '../../../../web/view/overlays/overlay';
import { createRibbons } from '../../../../web/view/overlays/ribbons';
import { createTrails } from '../../../../web/view/overlays/trails';
import { LOOKS } from '../../../../web/view/theme';
import { madeStander } from '../../support/made-stander';
import { randomMotion } from '../../support/skeletons';

const LOOK = LOOKS.dark;
const figureOf = (role: Figure['role'], motion: SolvedMotion, frame = 0): Figure => ({
  role,
  motion,
  joints: motion.positions.slice(frame * JOINT_COUNT * 3, (frame + 1) * JOINT_COUNT * 3),
});
const rounded = (values: ArrayLike<number>): number[] =>
  Array.from(values, (value) => Number(value.toFixed(4)) || 0);

describe('a ribbon', () => {
  const white = { r: 1, g: 1, b: 1 };

  it('has two edges along its points, and knows the way to the next one', () => {
    const ribbons = createRibbons(1, 3, false);
    ribbons.begin();
    for (const [x, z] of [
      [0, 0],
      [1, 0],
      [1, 2],
    ] as const)
      ribbons.point(x, 0, z, 0.1, white, 1);
    ribbons.commit();
    const { geometry } = ribbons.object;
    expect(rounded(geometry.getAttribute('across').array)).toEqual([0.1, -0.1, 0.1, -0.1, 0.1, -0.1]);
    const [first, second, third] = [
      [1, 0, 0],
      [0, 0, 2],
      [0, 0, 2],
    ];
    const ways = [first, first, second, second, third, third].flatMap((way) => way);
    expect(rounded(geometry.getAttribute('along').array)).toEqual(ways);
    expect([...geometry.index!.array]).toEqual([0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]);
  });

  it('ends where there is no more room, and one too many is left out', () => {
    const ribbons = createRibbons(1, 3, false);
    for (let ribbon = 0; ribbon < 2; ribbon++) {
      ribbons.begin();
      for (let i = 0; i < 5; i++) ribbons.point(i, ribbon, 0, 0.1, white, 1);
    }
    ribbons.commit();
    const { geometry } = ribbons.object;
    expect(geometry.drawRange.count).toBe(12);
    expect(rounded(geometry.getAttribute('position').array.slice(12))).toEqual([2, 0, 0, 2, 0, 0]);
  });
});

it('trails stay where the dance has ended', () => {
  const motion = randomMotion(60, 5);
  const trails = createTrails();
  trails.setLook(LOOK);
  const { geometry } = trails.object as Mesh;
  const drawn = (seconds: number): number[] => {
    trails.update([figureOf('leader', motion)], seconds);
    return [...geometry.getAttribute('position').array.slice(0, geometry.drawRange.count)];
  };
  const atEnd = drawn(59 / 30);
  expect(drawn(5)).toEqual(atEnd);
});

it('an arrow points where its dancer faces', () => {
  const facing = createFacing();
  facing.setLook(LOOK);
  const figure = figureOf('leader', randomMotion(3, 8));
  facing.update([figure], 0);
  const place = new Matrix4();
  (facing.object as InstancedMesh).getMatrixAt(0, place);
  const heading = headingOf(figure.joints);
  expect(Math.abs(Math.sin(heading))).toBeGreaterThan(0.1);
  const { x, z } = new Vector3(0, 0, 1).transformDirection(place);
  expect([x, z]).toEqual([expect.closeTo(Math.sin(heading), 5), expect.closeTo(Math.cos(heading), 5)]);
});

it('a link of hands begins in the colour of the leader and ends in that of the reactor, dots too', () => {
  const motion = randomMotion(3, 8);
  const [leader, reactor] = [figureOf('leader', motion), figureOf('reactor', motion)];
  for (const { joints } of [leader, reactor]) joints.set([5, 1, 0], J.left_wrist * 3);
  reactor.joints.set([5.2, 1, 0], J.right_wrist * 3);
  reactor.joints.set([9, 1, 0], J.left_wrist * 3);
  leader.joints.set([-9, 1, 0], J.right_wrist * 3);
  const links = createHandLinks();
  links.setLook(LOOK);
  links.update([leader, reactor], 0);
  const [line, dots] = links.object.children as [Mesh, InstancedMesh];
  const [ours, theirs, light] = [LOOK.leader, LOOK.reactor, LOOK.contrast].map((hex) =>
    rounded(new Color(hex).toArray()),
  );
  const rgba = line.geometry.getAttribute('rgba').array;
  expect(rounded(rgba.slice(0, 3))).toEqual(ours);
  const last = 4 * (2 * 25 - 1);
  expect(rounded(rgba.slice(last, last + 3))).toEqual(theirs);
  const colours = Array.from({ length: dots.count }, (_, i) =>
    rounded(dots.instanceColor!.array.slice(3 * i, 3 * i + 3)),
  );
  expect(colours).toEqual([light, ours, light, theirs]);
});

it('a ring is under a foot that stands a little above the floor, but not in the air', () => {
  const motion = madeStander({ frames: 90, path: () => [0, 0] });
  const rings = createContactRings();
  rings.setLook(LOOK);
  const heightOf = (lift: number): number => {
    const figure = figureOf('leader', motion, 45);
    const joints = figure.joints.map((value, i) => (i % 3 === 1 ? value + lift : value));
    rings.update([{ ...figure, joints }], 1.5);
    const place = new Matrix4();
    (rings.object as InstancedMesh).getMatrixAt(0, place);
    return new Vector3().setFromMatrixPosition(place).y;
  };
  const floor = heightOf(0);
  expect(heightOf(0.04) - floor).toBeCloseTo(0.04, 3);
  expect(heightOf(1) - floor).toBeLessThan(0.1);
});
