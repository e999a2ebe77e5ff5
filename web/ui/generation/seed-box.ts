import { SEEDS } from '../../model/client';
import { iconButton } from '../widgets/button';
import { el } from '../widgets/dom';
import { icon } from '../widgets/icons';
import { finishNumber, showNumber, takeBackOnEscape } from '../widgets/unfinished-number';
import type { Mount } from '../store/services';
import { seedLockSet, seedRandomized, seedSet, randomSeed } from '../store/actions/settings';
import { apply, watchAll } from '../store/store';

/** The seed: typed, chosen at random, or locked so that nothing but typing changes it. */
export const mountSeedBox: Mount = (root, store) => {
  const input = el('input', {
    attributes: {
      type: 'number',
      ...SEEDS,
      step: 1,
      'aria-label': 'Seed',
      inputmode: 'numeric',
      title: 'Each seed gives another reaction. The same seed and settings give the same one again',
    },
    on: {
      change: () => {
        apply(store, seedSet(input.valueAsNumber));
        finishNumber(input);
      },
    },
  });
  takeBackOnEscape(input);
  const roll = iconButton('icon', 'dice', { label: 'New random seed' }, () => {
    apply(store, seedRandomized(randomSeed()));
  });
  const lock = iconButton('icon lock', 'unlock', { label: 'Lock the seed' }, () => {
    apply(store, seedLockSet(!store.getState().seedLocked));
  });
  const box = el('span', { class: 'number' }, input, roll, lock);
  const label = el('span', { class: 'label', text: 'Seed', attributes: { 'aria-hidden': true } });
  root.append(label, box);

  const show = (): void => {
    const { settings, seedLocked } = store.getState();
    input.disabled = lock.disabled = !settings;
    roll.disabled = !settings || seedLocked;
    showNumber(input, settings ? String(settings.seed) : '');
    roll.title = seedLocked ? 'The seed is locked' : 'Another reaction (D)';
    lock.title = seedLocked ? 'Unlock the seed' : 'Lock the seed, so that it stays when you generate again';
    lock.setAttribute('aria-pressed', String(seedLocked));
    lock.replaceChildren(icon(seedLocked ? 'lock' : 'unlock'));
  };
  watchAll(store, (state) => [state.settings, state.seedLocked], show);
};
