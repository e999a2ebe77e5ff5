import { readFile } from 'node:fs/promises';
import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { View } from '../../../../web/common/framing';
import type { MotionClip } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { CoupleFollower } from '../../../../web/view/camera/couple-follower';
import { measureCouple, shotOf } from '../../../../web/view/camera/framing';
import { planHeading } from '../../../../web/view/camera/heading-plan';
import { OrbitCamera } from '../../../../web/view/camera/orbit-camera';
import { leaderBvh } from '../../support/leader-bvh';

/** From the joint of the head to the top of the skull, metres. */
const SKULL = 0.2;
/** Where the top of a head may be at most; 1 is the edge. */
const IN_PICTURE = 0.95;

async function demoDancer(name: string): Promise<MotionClip> {
  return leaderBvh(await readFile(`web/public/demo/${name}.bvh`, 'utf8')).clip;
}

/**
 * Farthest place of the top of a head in the picture over the whole dance: 1 is the edge.
 *
 * @param rate pictures a second
 */
function farthestHead(dancers: readonly MotionClip[], view: View, aspect: number, rate: number): number {
  const orbit = new OrbitCamera(null);
  orbit.resize(aspect * 900, 900);
  const follower = new CoupleFollower(orbit);
  const [leader, reactor] = dancers as [MotionClip, MotionClip];
  follower.setPlan(planHeading(leader, reactor));
  const jointsAt = (seconds: number): Float32Array[] =>
    dancers.map(({ positions, fps }) => {
      const frame = Math.round(seconds * fps);
      return positions.subarray(frame * JOINT_COUNT * 3, (frame + 1) * JOINT_COUNT * 3);
    });
  orbit.shot = shotOf(view, measureCouple(jointsAt(0)), aspect, follower.sideHeading(0));
  follower.startFrom(orbit.shot);
  const point = new Vector3();
  let far = 0;
  for (let seconds = 1 / rate; seconds < (leader.frames - 1) / leader.fps; seconds += 1 / rate) {
    const now = jointsAt(seconds);
    const dance = { couple: measureCouple(now), seconds, danced: true };
    follower.follow(view, 1 / rate, dance, { held: false, jumps: false });
    orbit.camera.updateMatrixWorld();
    for (const joints of now) {
      point.fromArray(joints, J.head * 3);
      point.y += SKULL;
      point.project(orbit.camera);
      far = Math.max(far, Math.abs(point.x), Math.abs(point.y));
    }
  }
  return far;
}

describe('the camera over the whole demo', async () => {
  const dancers = [await demoDancer('leader'), await demoDancer('reactor')];

  for (const view of ['orbit', 'follow', 'side'] as const)
    it.each([0.5, 0.8, 1.2, 1.6, 2.2])(
      `keeps both heads in the picture: ${view}, %f times as wide as high`,
      (aspect) => {
        for (const rate of [60, 12])
          expect(farthestHead(dancers, view, aspect, rate)).toBeLessThan(IN_PICTURE);
      },
    );
});
