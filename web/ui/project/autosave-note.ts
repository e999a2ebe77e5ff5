import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { AutosaveStatus } from '../store/state';
import { watchAll } from '../store/store';

/** Where the work of this tab is not saved although the browser would save it: why, and what the button offers. */
const NOTES: Readonly<Partial<Record<AutosaveStatus, { readonly text: string; readonly button: string }>>> = {
  elsewhere: {
    text: 'Your work is open in another tab, which saves it. Changes in this tab are not saved.',
    button: 'Save in this tab instead',
  },
  newer: {
    text: 'A newer version of this page has saved work here. This version leaves it unchanged and saves nothing.',
    button: 'Reload',
  },
};

/** Over the stage: what is being restored, and a note where another tab or version saves its work instead of this one. */
export const mountAutosaveNote: Mount = (root, store, services) => {
  const text = el('span');
  const button = textButton('btn tint', '', () => {
    if (store.getState().autosave === 'newer') location.reload();
    else services.storeHere();
  });
  const note = el('div', { class: 'float update kept', attributes: { role: 'status' } }, text, button);
  const coming = el('div', { class: 'float toast restoring', attributes: { role: 'status' } });
  root.append(note, coming);
  watchAll(
    store,
    (state) => [state.autosave, state.restoring],
    ({ autosave: status, restoring }) => {
      const shown = NOTES[status];
      note.hidden = !shown;
      setText(text, shown?.text ?? '');
      setText(button, shown?.button ?? '');
      // What is still being read cannot be written here yet.
      button.hidden = restoring !== null;
    },
  );
  watchAll(
    store,
    (state) => [state.restoring, state.leader],
    ({ restoring, leader }) => {
      // Once the couple is there, the rest comes quietly.
      coming.hidden = !restoring || leader !== null;
      setText(coming, restoring && !coming.hidden ? `Bringing back your work: ${restoring.what}` : '');
    },
  );
};
