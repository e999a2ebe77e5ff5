import { listen } from '../dom';
import { apply, type Store } from '../store';
import { redone, undone } from './history';

/** Ctrl or Command with Z, Shift Z and Y. Fields that are typed in have their own undo. */
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
