import { beforeEach, expect, it } from 'vitest';
import { CoupleFollower } from '../../../../web/view/camera/couple-follower';
import { type Couple, measureCouple, shotOf } from '../../../../web/view/camera/framing';
import { OrbitCamera } from '../../../../web/view/camera/orbit-camera';

const coupleAt = (x: number, z: number): Couple => ({ ...measureCouple([]), x, z });
let orbit: OrbitCamera;
let follower: CoupleFollower;
/** Goes on by a frame at a moment of the dance; gives the heading, radians. */
const headingAfter = (seconds: number): number => {
  const dance = { couple: coupleAt(0, 0), seconds, danced: true };
  follower.follow('orbit', 1 / 30, dance, { held: false, jumps: false });
  return orbit.shot.heading;
};

beforeEach(() => {
  orbit = new OrbitCamera(null);
  orbit.shot = shotOf('orbit', coupleAt(0, 0), orbit.aspect, 0);
  follower = new CoupleFollower(orbit);
  follower.startFrom(orbit.shot);
});

it('turns with the couple in the views that go around it, until the person has turned the camera', () => {
  const views = ['orbit', 'follow', 'side', 'top'] as const;
  expect(views.map((view) => follower.turnsIn(view))).toEqual([true, true, false, false]);
  follower.ownHeading = true;
  expect(views.map((view) => follower.turnsIn(view))).toEqual([false, false, false, false]);
});

it('does not turn for another dance at the same moment, but for the next moment', () => {
  follower.setPlan(() => 0);
  expect(headingAfter(3)).toBeCloseTo(0, 9);
  follower.setPlan(() => 1);
  expect(headingAfter(3)).toBeCloseTo(0, 9);
  expect(headingAfter(3.1)).toBeGreaterThan(0.01);
});

it('a view that was panned keeps its place beside the couple, wherever that is', () => {
  const framing = { ...follower.framing(coupleAt(1, -2)), ownDistance: true };
  expect(framing.tracked).toEqual([-1, 2]);
  const seen = { view: 'orbit', shot: orbit.shot, aspect: 1, ...framing } as const;
  follower.followAs(seen, coupleAt(5, 5));
  expect(follower.framing(coupleAt(5, 5))).toEqual(framing);
  expect(follower.framing(coupleAt(0, 0)).tracked).toEqual([4, 7]);
});
