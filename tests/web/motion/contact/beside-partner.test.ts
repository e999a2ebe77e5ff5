import { expect, test } from 'vitest';
import { stepCounts } from '../../../../web/motion/beats/step-timing';
import { besidePartner } from '../../../../web/motion/contact/beside-partner';
import { capsuleBody, candidatePairs, penetrationDepth } from '../../../../web/motion/contact/capsules';
import { eased, madeStander } from '../../support/made-stander';
import { small } from '../../support/small-manifest';

const FRAMES = 300;
const { penetration, glide } = small.quality;

test('who cannot keep up with a partner that spins goes round the partner, not through', () => {
  const leader = madeStander({ frames: FRAMES });
  // Three turns in three seconds at a distance of 0.6 m: 3.8 m/s.
  const angle = (f: number): number => 6 * Math.PI * eased(f, 90, 180);
  const reactor = madeStander({
    frames: FRAMES,
    path: (f) => [0.6 * Math.sin(angle(f)), 0.6 * Math.cos(angle(f))],
  });
  const kept = besidePartner(reactor, leader, small.quality, stepCounts([], FRAMES, 30), { holding: false });

  const trunks = penetration.capsules.filter(({ from, to }) => !/elbow|wrist/.test(from + to));
  const [a, b] = [leader, kept].map((motion) => capsuleBody(motion, { ...penetration, capsules: trunks }));
  const depths = Array.from({ length: FRAMES }, (_, f) =>
    penetrationDepth(a!, b!, candidatePairs(a!, b!, f)),
  );
  const speeds = Array.from(
    { length: FRAMES - 1 },
    (_, f) =>
      30 *
      Math.hypot(kept.root[3 * f + 3]! - kept.root[3 * f]!, kept.root[3 * f + 5]! - kept.root[3 * f + 2]!),
  );
  expect(Math.max(...speeds)).toBeLessThan(glide.free_speed + 1e-3);
  expect(Math.max(...depths)).toBeLessThan(0.05);
});
