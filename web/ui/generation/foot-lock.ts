import { el, combineDisposers } from '../widgets/dom';
import type { Mount } from '../store/services';
import { footLockSet } from '../store/actions/reaction';
import { apply, watch } from '../store/store';

const HINT = 'Keeps planted feet from sliding';

/** The switch for the foot lock; the reactor on the stage follows at once. */
export const mountFootLock: Mount = (root, store) => {
  const control = el(
    'button',
    {
      class: 'switch',
      attributes: { type: 'button', role: 'switch', 'aria-label': 'Foot lock', title: HINT },
      on: {
        click: () => {
          apply(store, footLockSet(!store.getState().footLock));
        },
      },
    },
    el('span', {}, 'Foot lock', el('small', { class: 'hint', text: HINT })),
    el('span', { class: 'knob', attributes: { 'aria-hidden': true } }),
  );
  const section = el('section', { class: 'sec foot-lock', attributes: { 'aria-label': 'Motion' } }, control);
  root.append(section);
  return combineDisposers(
    watch(
      store,
      (state) => state.footLock,
      (on) => {
        control.setAttribute('aria-checked', String(on));
      },
    ),
    () => {
      section.remove();
    },
  );
};
