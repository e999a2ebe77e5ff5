import { el } from '../widgets/dom';
import type { Take } from '../store/reaction';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { takeChosen, takeDeleted, takeStarred } from '../store/actions/takes';
import { createTakeRow, type TakeRow } from './take-row';
import { takeOnStage } from '../store/take';

/**
 * The takes as a grid with one row each. Tab leads to one row, the arrow keys to the others; Enter shows a take on the
 * stage, F2 renames it, Delete deletes it and S stars it.
 */
export class TakeList {
  readonly root: HTMLElement;
  readonly #store: Store;
  readonly #heading: HTMLElement;
  /** Rows by the id of their take, in the order of the takes. */
  #rows: ReadonlyMap<string, TakeRow> = new Map();
  /** The take whose row Tab leads to: the one that had the focus last, else the one on the stage. */
  #current: string | null = null;

  /** @param heading names the list, and gets the focus when the last take is deleted */
  constructor(store: Store, heading: HTMLElement) {
    this.#store = store;
    this.#heading = heading;
    this.root = el('div', {
      class: 'takes',
      attributes: { role: 'grid', 'aria-labelledby': heading.id },
      on: {
        keydown: (event) => {
          if (!this.#press(event)) return;
          event.preventDefault();
          event.stopPropagation();
        },
        focusin: (event) => {
          const row = event.target instanceof Element ? event.target.closest('[data-take]') : null;
          const id = row?.getAttribute('data-take') ?? null;
          if (id === this.#current) return;
          this.#current = id;
          this.show(store.getState());
        },
      },
    });
    fadeEnds(this.root);
  }

  /** Shows the takes of this state; a deleted row that had the focus hands it to the row in its place, the last one to the heading. */
  show(state: AppState): void {
    const { takes } = state;
    const hasFocus = this.root.contains(document.activeElement);
    const isThere = takes.some(({ id }) => id === this.#current);
    const deleted = hasFocus && !isThere;
    if (deleted) this.#current = this.#successor(takes);
    else if (!isThere) this.#current = takeOnStage(state)?.id ?? takes[0]?.id ?? null;
    this.#updateRows(takes);
    for (const take of takes) this.#rows.get(take.id)?.show(take, state, take.id === this.#current);
    if (deleted && this.#current) this.#focus(this.#current);
    else if (deleted) this.#heading.focus();
    this.root.hidden = takes.length === 0;
  }

  /** Scrolls the list, and nothing around it, until the row of this take is in sight and not faded. */
  reveal(id: string | undefined): void {
    const index = [...this.#rows.keys()].indexOf(id ?? '');
    const row = this.#rows.get(id ?? '')?.root;
    if (!row) return;
    const list = this.root;
    const faded = row.offsetHeight / 2;
    // By its index: the row on the stage sticks to the ends of the list, so that its own place does not tell.
    const top = index * row.offsetHeight - faded;
    const bottom = top + row.offsetHeight + 2 * faded;
    if (top < list.scrollTop) list.scrollTop = top;
    else if (bottom > list.scrollTop + list.clientHeight) list.scrollTop = bottom - list.clientHeight;
  }

  /** The take that moves into the place of the current one, which was deleted. */
  #successor(takes: readonly Take[]): string | null {
    const place = [...this.#rows.keys()].indexOf(this.#current ?? '');
    return takes[Math.max(0, Math.min(takes.length - 1, place))]?.id ?? null;
  }

  /** Removes rows of deleted takes, adds rows of new ones and puts all in the order of the takes. */
  #updateRows(takes: readonly Take[]): void {
    const before = this.#rows;
    this.#rows = new Map(takes.map(({ id }) => [id, before.get(id) ?? createTakeRow(this.#store, id)]));
    for (const [id, row] of before) if (!this.#rows.has(id)) row.root.remove();
    [...this.#rows.values()].forEach(({ root }, index) => {
      const there = this.root.children[index] ?? null;
      if (there !== root) this.root.insertBefore(root, there);
    });
  }

  #focus(id: string | null | undefined): void {
    if (id) this.#rows.get(id)?.root.focus();
  }

  /** Handles a key; false when it has no meaning here. */
  #press(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const { takes } = this.#store.getState();
    const at = takes.findIndex(({ id }) => id === this.#current);
    const id = takes[at]?.id;
    if (id === undefined) return false;
    const onRow = event.target instanceof Element && event.target.matches('[data-take]');
    switch (event.key) {
      case 'ArrowDown':
        this.#focus(takes[Math.min(takes.length - 1, at + 1)]?.id);
        return true;
      case 'ArrowUp':
        this.#focus(takes[Math.max(0, at - 1)]?.id);
        return true;
      case 'Home':
        this.#focus(takes[0]?.id);
        return true;
      case 'End':
        this.#focus(takes.at(-1)?.id);
        return true;
      case 'Enter':
        if (onRow) apply(this.#store, takeChosen(id));
        return onRow;
      case 'F2':
        this.#rows.get(id)?.rename();
        return true;
      case 'Delete':
      case 'Backspace':
        // Held, it would delete all.
        if (!event.repeat) apply(this.#store, takeDeleted(id));
        return true;
      case 's':
      case 'S':
        if (!event.repeat) apply(this.#store, takeStarred(id));
        return true;
    }
    return false;
  }
}

/** Fades the ends of a list beyond which it can be scrolled. */
function fadeEnds(list: HTMLElement): void {
  const fade = (): void => {
    list.classList.toggle('above', list.scrollTop > 1);
    list.classList.toggle('below', list.scrollTop + list.clientHeight < list.scrollHeight - 1);
  };
  new ResizeObserver(fade).observe(list);
  list.addEventListener('scroll', fade, { passive: true });
  new MutationObserver(fade).observe(list, { childList: true });
}
