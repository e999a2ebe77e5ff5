/** Motions that are known, for videos: our own to the millimetre, that of a person to a few centimetres. */
import { solve } from '../../../../web/motion/fit/ik';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import slow from '../../../../web/public/leaders/slow.bvh?raw';
import person from '../../../fixtures/video/person/truth.json';
import salsa from '../../../fixtures/video/mannequin/salsa.bvh?raw';
import { leaderBvh } from '../leader-bvh';
import type { MotionName } from './shots';
import { walker } from './walker';

export function motionOf(name: MotionName): SolvedMotion {
  switch (name) {
    case 'salsa':
      return solve(leaderBvh(salsa).clip);
    case 'slow':
      return solve(leaderBvh(slow).clip);
    case 'turning':
      return walker({ seconds: 6, turn: 0.45, distance: 0 });
    case 'spinning':
      return walker({ seconds: 4, turn: 0.9, distance: 0 });
    case 'balancing':
      return solve({
        fps: person.fps,
        frames: person.millimetres.length / (3 * JOINT_COUNT),
        positions: Float32Array.from(person.millimetres, (value) => value / 1000),
      });
    case 'walking':
      return walker({ seconds: 6, turn: 0, distance: 1.4 });
  }
}
