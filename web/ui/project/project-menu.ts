import { closeButton } from '../widgets/close-button';
import { el, listen, setAttribute, setText, together } from '../widgets/dom';
import { icon, type IconName } from '../widgets/icons';
import type { Mount } from '../store/services';
import type { KeepingState } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { opened } from '../store/actions/view';
import { worthKeeping } from './schema';

const HEADS: Readonly<Record<KeepingState, string>> = {
  kept: 'Kept in this browser until you start afresh',
  full: 'Not all of it is kept: this browser’s space is full',
  refused: 'This browser keeps nothing for the page',
};

/** The project in the bar: saving and opening all of it as one file, and starting afresh. */
export const mountProjectMenu: Mount = (root, store, services) => {
  const toggle = (): void => {
    apply(store, opened('project'));
  };
  const door = el(
    'button',
    {
      class: 'icon desk',
      attributes: { type: 'button', 'aria-label': 'Project', 'aria-haspopup': 'dialog', title: 'Project' },
      on: { click: toggle },
    },
    icon('folder'),
  );
  const entry = (sign: IconName, name: string, words: string, run: () => void): HTMLButtonElement =>
    el(
      'button',
      {
        class: 'it',
        attributes: { type: 'button' },
        on: {
          click: () => {
            toggle();
            run();
          },
        },
      },
      icon(sign),
      el('span', {}, el('b', { text: name }), el('small', { text: words })),
    );
  const save = entry(
    'save',
    'Save project',
    'Song, leader, takes and settings in one file',
    services.saveProject,
  );
  const open = entry('folder', 'Open a project', 'In the place of what is here; undo brings it back', () => {
    services.choose('project');
  });
  const afresh = entry(
    'remove',
    'Start afresh',
    'Empties the page; undo brings it back',
    services.startAfresh,
  );
  const head = el('h2');
  const menu = el(
    'div',
    { class: 'float menu project', attributes: { role: 'dialog', 'aria-label': 'Project' } },
    el('div', { class: 'row' }, head, closeButton(toggle)),
    save,
    open,
    afresh,
  );
  menu.hidden = true;
  root.append(door, menu);

  return together(
    watch(
      store,
      (state) => state.open === 'project',
      (isOpen) => {
        const inside = menu.contains(document.activeElement);
        menu.hidden = !isOpen;
        setAttribute(door, 'aria-expanded', isOpen ? 'true' : 'false');
        if (isOpen) (save.disabled ? open : save).focus();
        else if (inside) door.focus();
      },
    ),
    watch(
      store,
      (state) => state.keeping,
      (keeping) => {
        setText(head, HEADS[keeping]);
      },
    ),
    watchAll(
      store,
      (state) => [state.leader, state.song, state.takes],
      (state) => {
        save.disabled = !state.leader && !state.song;
        afresh.disabled = !worthKeeping(state);
      },
    ),
    listen(window, 'pointerdown', ({ target }) => {
      if (!menu.hidden && target instanceof Node && ![menu, door].some((part) => part.contains(target)))
        toggle();
    }),
    listen(window, 'keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
      if (event.key.toLowerCase() !== 's') return;
      // Also while there is nothing to save: nobody wants the page itself as a file.
      event.preventDefault();
      if (!save.disabled) services.saveProject();
    }),
    () => {
      door.remove();
      menu.remove();
    },
  );
};
