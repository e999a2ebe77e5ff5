import { el } from '../widgets/dom';
import type { Mount } from '../store/services';
import { footLockSet } from '../store/actions/reaction';
import { holdHandsSet } from '../store/actions/settings';
import { apply, watch } from '../store/store';

/** A switch with a hint below its name. */
function createSwitch(name: string, hint: string, click: () => void): HTMLButtonElement {
  return el(
    'button',
    {
      class: 'switch',
      attributes: { type: 'button', role: 'switch', 'aria-label': name, title: hint },
      on: { click },
    },
    el('span', {}, name, el('small', { class: 'hint', text: hint })),
    el('span', { class: 'knob', attributes: { 'aria-hidden': true } }),
  );
}

/** The switches for held hands, a setting of the reaction, and for the foot lock, which the stage follows at once. */
export const mountMotionSwitches: Mount = (root, store) => {
  const hands = createSwitch('Hold hands', 'Joins hands that are near', () => {
    apply(store, holdHandsSet(!store.getState().settings?.holdHands));
  });
  const feet = createSwitch('Foot lock', 'Keeps feet that stand from sliding', () => {
    apply(store, footLockSet(!store.getState().footLock));
  });
  const section = el(
    'section',
    { class: 'sec motion-switches', attributes: { 'aria-label': 'Motion' } },
    hands,
    feet,
  );
  root.append(section);
  watch(
    store,
    (state) => state.settings,
    (settings) => {
      hands.disabled = !settings;
      hands.setAttribute('aria-checked', String(settings?.holdHands ?? true));
    },
  );
  watch(
    store,
    (state) => state.footLock,
    (on) => {
      feet.setAttribute('aria-checked', String(on));
    },
  );
};
