import { iconButton, setDisabled } from '../widgets/button';
import type { IconName } from '../widgets/icons';
import { isUnfinished } from '../widgets/unfinished-number';
import type { Mount, Services } from '../store/services';
import { watchAll } from '../store/store';
import { askedLast } from '../store/history/asked';

/** Undo and redo as two buttons. */
export const mountUndo: Mount = (root, store, services) => {
  const button = (name: IconName, label: string, title: string, press: () => void): HTMLButtonElement =>
    iconButton('icon undo', name, { label, title }, press);
  const undo = button('undo', 'Undo', 'Undo (Ctrl Z)', services.undo);
  const redo = button('redo', 'Redo', 'Redo (Ctrl Y)', services.redo);
  root.append(undo, redo);
  watchAll(
    store,
    (state) => [state.history, state.asked],
    (state) => {
      setDisabled(undo, state.history.past.length === 0 && askedLast(state) === null);
      setDisabled(redo, state.history.future.length === 0);
    },
  );
};

/** Undo and redo by Ctrl or Command with Z, Shift Z and Y; texts, and numbers that are being typed, have their own. */
export function mountUndoKeys(services: Pick<Services, 'undo' | 'redo'>): void {
  window.addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    if (hasOwnUndo(event.target)) return;
    const key = event.key.toLowerCase();
    if (key === 'z' && !event.shiftKey) services.undo();
    else if (key === 'z' || (key === 'y' && !event.shiftKey)) services.redo();
    else return;
    event.preventDefault();
  });
}

function hasOwnUndo(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement && target.type === 'number') return isUnfinished(target);
  return target instanceof Element && target.matches('input[type="text"], textarea');
}
