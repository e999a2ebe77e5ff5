import { closeButton } from '../widgets/close-button';
import { el, listen, setText, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { panelToggled } from '../store/actions/view';
import { takeChosen, takeDeleted, takeStarred } from '../store/actions/takes';
import { createTakeRow, type TakeRow } from './take-row';
import { takeOnStage } from '../store/take';
import { mountUndo } from './undo';

/** The list of takes in the panel; on the phone a sheet over the page. */
export const mountTakes: Mount = (root, store, services) => {
  const rows = new Map<string, TakeRow>();
  /** The row that Tab leads to: the one the arrows were on last, else the one on the stage. */
  let current: string | null = null;

  const list = el('div', {
    class: 'takes',
    attributes: { role: 'grid', 'aria-labelledby': 'takes-head' },
    on: {
      keydown: (event) => {
        if (press(event)) {
          event.preventDefault();
          event.stopPropagation();
        }
      },
      focusin: (event) => {
        const row = event.target instanceof Element ? event.target.closest('[data-take]') : null;
        const id = row?.getAttribute('data-take') ?? null;
        if (id === current) return;
        current = id;
        show(store.getState());
      },
    },
  });
  const empty = el('p', {
    class: 'empty-line',
    text: 'Every partner that is made becomes a take. Mark two of them A and B to compare them on the same beat.',
  });
  const count = el('span', { class: 'muted' });
  const close = closeButton(() => {
    apply(store, panelToggled('takes'));
  });
  close.classList.add('phone-only');
  const project = el('button', {
    class: 'btn tint phone-only',
    text: 'Project',
    attributes: { type: 'button', 'aria-haspopup': 'dialog' },
    on: {
      click: () => {
        apply(store, panelToggled('project'));
      },
    },
  });
  const head = el(
    'div',
    { class: 'head' },
    el('h2', { text: 'Takes', attributes: { id: 'takes-head' } }),
    count,
    project,
  );
  const section = el(
    'section',
    { class: 'sec takes-sec', attributes: { 'aria-labelledby': 'takes-head' } },
    head,
    list,
    empty,
  );
  const undo = mountUndo(head, store, services);
  head.append(close);
  root.append(section);

  const focusRow = (id: string | undefined): void => {
    if (id !== undefined) rows.get(id)?.root.focus();
  };
  const press = (event: KeyboardEvent): boolean => {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const { takes } = store.getState();
    const at = takes.findIndex(({ id }) => id === current);
    const id = takes[at]?.id;
    if (id === undefined) return false;
    const onRow = event.target instanceof Element && event.target.matches('[data-take]');
    switch (event.key) {
      case 'ArrowDown':
        focusRow(takes[Math.min(takes.length - 1, at + 1)]?.id);
        return true;
      case 'ArrowUp':
        focusRow(takes[Math.max(0, at - 1)]?.id);
        return true;
      case 'Home':
        focusRow(takes[0]?.id);
        return true;
      case 'End':
        focusRow(takes.at(-1)?.id);
        return true;
      case 'Enter':
        if (onRow) apply(store, takeChosen(id));
        return onRow;
      case 'F2':
        rows.get(id)?.rename();
        return true;
      case 'Delete':
      case 'Backspace':
        apply(store, takeDeleted(id));
        return true;
      case 's':
      case 'S':
        apply(store, takeStarred(id));
        return true;
    }
    return false;
  };

  const show = (state: AppState): void => {
    const { takes } = state;
    const focused = document.activeElement;
    const inside = list.contains(focused);
    const place = takes.findIndex(({ id }) => id === current);
    const onStage = takeOnStage(state)?.id;
    if (place < 0 && !inside) current = onStage ?? takes[0]?.id ?? null;
    const gone = inside && place < 0;
    // A row that was deleted under the focus hands it to the one that moves up.
    const heir = gone ? Math.min(takes.length - 1, [...rows.keys()].indexOf(current ?? '')) : -1;
    if (gone) current = takes[Math.max(0, heir)]?.id ?? null;

    for (const [id, row] of rows)
      if (!takes.some((take) => take.id === id)) {
        row.root.remove();
        rows.delete(id);
      }
    const before = new Map(rows);
    rows.clear();
    takes.forEach((take, index) => {
      const row = before.get(take.id) ?? createTakeRow(store, take.id);
      rows.set(take.id, row);
      if (list.children[index] !== row.root) list.insertBefore(row.root, list.children[index] ?? null);
      row.show(take, state, take.id === current);
    });
    if (gone) focusRow(current ?? undefined);
    empty.hidden = takes.some(({ reaction }) => reaction.label === null);
    list.hidden = takes.length === 0;
    setText(count, takes.length > 1 ? String(takes.length) : '');
  };

  return together(
    watchAll(
      store,
      ({ takes, reaction, other, letter, leader, song, manifest }) => [
        takes,
        reaction,
        other,
        letter,
        leader,
        song,
        manifest,
      ],
      show,
    ),
    watch(
      store,
      (state) => takeOnStage(state)?.id,
      (id) => {
        if (id !== undefined) reveal(list, rows.get(id)?.root);
      },
    ),
    watch(
      store,
      (state) => state.openPanel === 'takes',
      (open) => {
        section.classList.toggle('open', open);
        if (open) close.focus();
      },
    ),
    listen(window, 'pointerdown', ({ target }) => {
      const outside =
        target instanceof Element && !section.contains(target) && !target.closest('.takes-door');
      if (outside && store.getState().openPanel === 'takes') apply(store, panelToggled('takes'));
    }),
    fadeEnds(list),
    undo,
    () => {
      section.remove();
    },
  );
};

/** Scrolls the list, and nothing around it, until the row is in sight, clear of the ends that fade. */
function reveal(list: HTMLElement, row: HTMLElement | undefined): void {
  if (!row) return;
  const faded = row.offsetHeight / 2;
  const top = row.offsetTop - list.offsetTop - faded;
  const bottom = top + row.offsetHeight + 2 * faded;
  if (top < list.scrollTop) list.scrollTop = top;
  else if (bottom > list.scrollTop + list.clientHeight) list.scrollTop = bottom - list.clientHeight;
}

/** Lets the ends of the list fade beyond which it goes on. Returns how to stop. */
function fadeEnds(list: HTMLElement): () => void {
  const fade = (): void => {
    list.classList.toggle('above', list.scrollTop > 1);
    list.classList.toggle('below', list.scrollTop + list.clientHeight < list.scrollHeight - 1);
  };
  const sizes = new ResizeObserver(fade);
  sizes.observe(list);
  list.addEventListener('scroll', fade, { passive: true });
  const rows = new MutationObserver(fade);
  rows.observe(list, { childList: true });
  return () => {
    sizes.disconnect();
    rows.disconnect();
    list.removeEventListener('scroll', fade);
  };
}
