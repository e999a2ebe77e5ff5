import { el, together } from '../dom';
import { icon, type IconName } from '../icons';
import type { Mount } from '../services';
import { apply, type Change, watchAll } from '../store';
import { redone, undone } from './history';

/** Undo and redo as two buttons. */
export const mountUndo: Mount = (root, store) => {
  const button = (sign: IconName, label: string, title: string, change: Change): HTMLButtonElement =>
    el(
      'button',
      {
        class: 'icon undo',
        attributes: { type: 'button', 'aria-label': label, title },
        on: {
          click: () => {
            apply(store, change);
          },
        },
      },
      icon(sign),
    );
  const undo = button('undo', 'Undo', 'Undo (Ctrl Z)', undone());
  const redo = button('redo', 'Redo', 'Redo (Ctrl Y)', redone());
  root.append(undo, redo);
  return together(
    watchAll(
      store,
      (state) => [state.history],
      ({ history }) => {
        undo.disabled = history.past.length === 0;
        redo.disabled = history.future.length === 0;
      },
    ),
    () => {
      undo.remove();
      redo.remove();
    },
  );
};
