import { textButton, closeButton } from '../widgets/button';
import { el, setAttribute, setHidden, setText, returnFocusOf } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';
import { hasTakesToClear, starredKept } from '../store/actions/takes';
import { panelToggled } from '../store/actions/view';
import { TakeList } from './take-list';
import { takeOnStage } from '../store/take';
import { mountUndo } from './undo';

/** The section of takes in the panel; on the phone a sheet over the page. */
export const mountTakes: Mount = (root, store, services) => {
  const heading = el('h2', { text: 'Takes', attributes: { id: 'takes-head', tabindex: -1 } });
  const list = new TakeList(store, heading);
  const empty = el('p', {
    class: 'empty-line',
    text: 'Each new dance is kept here as a take. Mark two takes A and B to compare them at the same moment.',
  });
  const coming = el('ul', {
    class: 'takes-coming',
    attributes: { 'aria-label': 'Takes that are being read' },
  });
  const count = el('span', { class: 'muted' });
  const close = createPhoneClose(store);
  const clear = createClearButton(store);
  const head = el('div', { class: 'head' }, heading, count, clear, createProjectButton(store));
  const section = el(
    'section',
    { class: 'sec takes-sec', attributes: { 'aria-labelledby': heading.id } },
    head,
    list.root,
    coming,
    empty,
  );
  mountUndo(head, store, services);
  head.append(close);
  root.append(section);

  const show = (state: AppState): void => {
    const { takes } = state;
    list.show(state);
    const missing = comingTitles(state);
    coming.replaceChildren(...missing.map((title) => el('li', { text: title })));
    coming.hidden = missing.length === 0;
    empty.hidden = !coming.hidden || takes.some(({ reaction }) => reaction.label === null);
    const all = takes.length + missing.length;
    setText(count, all > 1 ? String(all) : '');
    setHidden(clear, !hasTakesToClear(state), heading);
  };
  watchAll(
    store,
    ({ takes, reaction, other, letter, leader, song, manifest, restoring }) => [
      restoring,
      takes,
      reaction,
      other,
      letter,
      leader,
      song,
      manifest,
    ],
    show,
  );
  watchAll(
    store,
    (state) => [takeOnStage(state)?.id, state.takes.length],
    (state) => {
      list.reveal(takeOnStage(state)?.id);
    },
  );
  watchSheet(section, close, store);
  closeOutside(section, store);
};

/** Opens and closes the sheet of the phone. */
function watchSheet(section: HTMLElement, close: HTMLElement, store: Store): void {
  const returnFocus = returnFocusOf(section);
  watch(
    store,
    (state) => state.openPanel === 'takes',
    (open) => {
      returnFocus(open);
      section.classList.toggle('open', open);
      // Only where it covers the page is it what its button says that it opens.
      setAttribute(section, 'role', open && 'dialog');
      if (open) close.focus();
    },
  );
}

/** Closes the sheet of the phone. */
function createPhoneClose(store: Store): HTMLButtonElement {
  const button = closeButton(() => {
    apply(store, panelToggled('takes'));
  });
  button.classList.add('phone-only');
  return button;
}

/** Removes all takes without a star. */
function createClearButton(store: Store): HTMLButtonElement {
  const button = textButton('btn ghost', 'Keep starred', () => {
    apply(store, starredKept());
  });
  button.title = 'Removes all takes without a star. Undo brings them back.';
  return button;
}

/** Titles of the takes of an earlier visit that are still being read. */
function comingTitles({ takes, restoring }: AppState): string[] {
  const there = new Set(takes.map(({ id }) => id));
  return restoring?.takes.filter(({ id }) => !there.has(id)).map(({ title }) => title) ?? [];
}

/** On the phone, the button that opens the sheet of takes, with their number. */
export const mountTakesButton: Mount = (root, store) => {
  const count = el('span', { class: 'muted' });
  const button = el(
    'button',
    {
      class: 'btn takes-button',
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
  root.append(button);
  watchAll(
    store,
    ({ takes, openPanel }) => [takes.length, openPanel === 'takes'],
    ({ takes, openPanel }) => {
      setText(count, takes.length > 0 ? String(takes.length) : '');
      button.setAttribute('aria-expanded', String(openPanel === 'takes'));
    },
  );
};

/** On the phone, the button that opens the project menu. */
function createProjectButton(store: Store): HTMLElement {
  return textButton(
    'btn tint phone-only',
    'Project',
    () => {
      apply(store, panelToggled('project'));
    },
    { 'aria-haspopup': 'dialog' },
  );
}

/** Closes the sheet when the pointer goes down outside it. */
function closeOutside(section: HTMLElement, store: Store): void {
  window.addEventListener('pointerdown', ({ target }) => {
    const outside =
      target instanceof Element && !section.contains(target) && !target.closest('.takes-button');
    if (outside && store.getState().openPanel === 'takes') apply(store, panelToggled('takes'));
  });
}
