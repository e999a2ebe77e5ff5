import { closeButton } from '../widgets/button';
import { el, onPressOutside, setOpen, setText } from '../widgets/dom';
import { icon, type IconName } from '../widgets/icons';
import type { Mount, Services } from '../store/services';
import type { AutosaveStatus } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { panelToggled } from '../store/actions/view';
import { persistenceText } from '../store/selectors';
import { hasVisitorContent } from './stored-project';

const HEADINGS: Readonly<Record<AutosaveStatus, string>> = {
  stored: 'Saved in this browser until you start over',
  full: 'Not everything is saved: this browser’s storage is full',
  refused: 'This browser saves nothing for the page',
  elsewhere: 'Another tab is saving; this tab is not saved',
  newer: 'A newer version is saving; this one is not saved',
};

interface Elements {
  readonly opener: HTMLButtonElement;
  readonly menu: HTMLElement;
  readonly head: HTMLElement;
  readonly persistence: HTMLElement;
  readonly save: HTMLButtonElement;
  readonly open: HTMLButtonElement;
  readonly clear: HTMLButtonElement;
}

/** The project menu in the bar: saving and opening everything as one file, and starting over. */
export const mountProjectMenu: Mount = (root, store, services) => {
  const toggle = (): void => {
    apply(store, panelToggled('project'));
  };
  const elements = build(services, toggle);
  const { opener, menu, head, persistence, save, open, clear } = elements;
  root.append(opener, menu);
  watch(
    store,
    (state) => state.openPanel === 'project',
    (isOpen) => {
      setOpen(menu, opener, isOpen, () => (save.disabled ? open : save));
    },
  );
  watchAll(
    store,
    (state) => [state.autosave, state.persistent],
    (state) => {
      setText(head, HEADINGS[state.autosave]);
      const sentence = persistenceText(state);
      setText(persistence, sentence ?? '');
      persistence.hidden = sentence === null;
    },
  );
  watchAll(
    store,
    (state) => [state.leader, state.song, state.takes, state.countings, state.restoring],
    (state) => {
      // What is still being restored would be missing in the file, and could not be brought back.
      save.disabled = state.restoring !== null || (!state.leader && !state.song);
      clear.disabled = state.restoring !== null || !hasVisitorContent(state);
    },
  );
  onPressOutside([menu, opener], () => {
    if (!menu.hidden) toggle();
  });
  window.addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    if (event.key.toLowerCase() !== 's') return;
    // Also while there is nothing to save: nobody wants the page itself as a file.
    event.preventDefault();
    if (!save.disabled) services.saveProject();
  });
};

function build(services: Services, toggle: () => void): Elements {
  const opener = el(
    'button',
    {
      class: 'icon desk',
      attributes: { type: 'button', 'aria-label': 'Project', 'aria-haspopup': 'dialog', title: 'Project' },
      on: { click: toggle },
    },
    icon('folder'),
  );
  const entry = (symbol: IconName, name: string, hint: string, run: () => void): HTMLButtonElement =>
    menuEntry(symbol, name, hint, () => {
      toggle();
      run();
    });
  const save = entry(
    'save',
    'Save project',
    'Song, the leader’s motion, takes and settings in one file',
    services.saveProject,
  );
  const open = entry('folder', 'Open a project', 'Replaces what is here; undo brings it back', () => {
    services.choose('project');
  });
  const clear = entry(
    'remove',
    'Start over',
    'Empties the page; undo brings it back until you make a take or leave the page',
    services.clearProject,
  );
  const record = entry(
    'leader',
    'Record a leader',
    'With the camera, up to two minutes; the song plays meanwhile',
    services.recordVideo,
  );
  const head = el('h2');
  const persistence = el('p', { class: 'persistence' });
  const menu = el(
    'div',
    { class: 'float menu project', attributes: { role: 'dialog', 'aria-label': 'Project' } },
    el('div', { class: 'row' }, head, closeButton(toggle)),
    persistence,
    save,
    open,
    record,
    clear,
  );
  menu.hidden = true;
  return { opener, menu, head, persistence, save, open, clear };
}

function menuEntry(symbol: IconName, name: string, hint: string, run: () => void): HTMLButtonElement {
  return el(
    'button',
    { class: 'menu-item', attributes: { type: 'button' }, on: { click: run } },
    icon(symbol),
    el('span', {}, el('b', { text: name }), el('small', { text: hint })),
  );
}
