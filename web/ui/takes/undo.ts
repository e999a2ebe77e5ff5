import { iconButton } from '../widgets/button';
import { listen, combineDisposers } from '../widgets/dom';
import type { IconName } from '../widgets/icons';
import type { Mount } from '../store/services';
import { apply, type Change, type Store, watchAll } from '../store/store';
import { redone, undone } from '../store/history/history';

/** Undo and redo as two buttons. */
export const mountUndo: Mount = (root, store) => {
  const button = (name: IconName, label: string, title: string, change: Change): HTMLButtonElement =>
    iconButton('icon undo', name, { label, title }, () => {
      apply(store, change);
    });
  const undo = button('undo', 'Undo', 'Undo (Ctrl Z)', undone());
  const redo = button('redo', 'Redo', 'Redo (Ctrl Y)', redone());
  root.append(undo, redo);
  return combineDisposers(
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

/** Undo and redo by Ctrl or Command with Z, Shift Z and Y; text fields have their own undo. */
export function mountUndoKeys(store: Store): () => void {
  return listen(window, 'keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    if (event.target instanceof Element && event.target.matches('input:not([type="range"]), textarea'))
      return;
    const key = event.key.toLowerCase();
    if (key === 'z') apply(store, event.shiftKey ? redone() : undone());
    else if (key === 'y' && !event.shiftKey) apply(store, redone());
    else return;
    event.preventDefault();
  });
}
