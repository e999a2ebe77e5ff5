import { expect, test } from 'vitest';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { reactorMotion } from '../../../../web/ui/store/reactor-motion';
import { footLockSet, reactionAdded } from '../../../../web/ui/store/actions/reaction';
import { dancers } from '../../../../web/ui/store/roles';
import { apply, createAppStore, leaderLoaded, manifestLoaded, settingsSet } from '../../support/actions';
import { madeStander } from '../../support/made-stander';
import { madeSettings, leader } from '../../support/made-state';
import { small } from '../../support/small-manifest';

test('the foot lock is on at first, and switching it changes the motion that is drawn, not the generated one', () => {
  const motion = madeStander({ frames: 90, path: (frame) => [0.05 * Math.sin(frame / 4.8), 0] });
  const made = motion.positions.slice();
  const store = createAppStore('dark');
  const shown = () => reactorMotion(store.getState());
  expect(shown()).toBeNull();

  const inputs = { leader: leader(90), song: null, shift: 0, settings: madeSettings };
  apply(store, reactionAdded({ motion, latents: null, inputs, label: null, seconds: 1 }));
  const locked = shown();
  const ankles = locked!.positions.filter((_, i) => i % (JOINT_COUNT * 3) === J.left_ankle * 3);
  expect(Math.max(...ankles) - Math.min(...ankles)).toBeLessThan(0.04);

  apply(store, footLockSet(false));
  expect(shown()).toBe(motion);
  expect(motion.positions).toEqual(made);
  apply(store, footLockSet(true));
  // The same object, so that nothing is drawn or computed anew without need.
  expect(shown()).toBe(locked);
});

test('the dancer that was loaded has the role that is not generated', () => {
  const store = createAppStore('dark');
  const loaded = leader(90);
  apply(store, leaderLoaded(loaded));
  expect(dancers(store.getState())).toEqual({ leader: loaded.motion, reactor: null });
  apply(store, manifestLoaded(small, 7));
  apply(store, settingsSet({ ...madeSettings, role: 'leader' }));
  expect(dancers(store.getState())).toEqual({ leader: null, reactor: loaded.motion });
});
