import { el, setText, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import { apply, watchAll } from '../store/store';
import { panelToggled } from '../store/actions/view';

/** On the phone, the button that opens the sheet of takes, with how many there are. */
export const mountTakesDoor: Mount = (root, store) => {
  const count = el('span', { class: 'muted' });
  const door = el(
    'button',
    {
      class: 'btn takes-door',
      attributes: { type: 'button', 'aria-haspopup': 'dialog' },
      on: {
        click: () => {
          apply(store, panelToggled('takes'));
        },
      },
    },
    'Takes ',
    count,
  );
  root.append(door);
  return together(
    watchAll(
      store,
      ({ takes, openPanel }) => [takes.length, openPanel === 'takes'],
      ({ takes, openPanel }) => {
        setText(count, takes.length > 0 ? String(takes.length) : '');
        door.setAttribute('aria-expanded', String(openPanel === 'takes'));
      },
    ),
    () => {
      door.remove();
    },
  );
};
