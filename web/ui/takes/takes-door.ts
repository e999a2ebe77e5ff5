import { el } from '../dom';
import type { Mount } from '../services';
import { apply } from '../store';
import { opened } from '../view-changes';

/** On the phone, the way from the sheet of the share button to the one with the takes. */
export const mountTakesDoor: Mount = (root, store) => {
  const door = el('button', {
    class: 'btn tint phone-only takes-door',
    text: 'Takes and project',
    attributes: { type: 'button' },
    on: {
      click: () => {
        apply(store, opened('takes'));
      },
    },
  });
  root.append(door);
  return () => {
    door.remove();
  };
};
