import { el, setAttribute, setText } from '../widgets/dom';
import { icon, type IconName } from '../widgets/icons';
import type { AppState, Letter, Take } from '../store/state';
import { apply, type Store } from '../store/store';
import {
  letterGiven,
  takeChosen,
  takeDeleted,
  takeRenamed,
  takeStarred,
  whyNoLetter,
} from '../store/actions/takes';
import { letterOf, takeTitle } from '../store/take';
import { createTakeName } from './take-name';
import { allTakeWords, takeWords } from './take-words';

const LETTERS: readonly Letter[] = ['A', 'B'];

/** One take in the list. */
export interface TakeRow {
  readonly root: HTMLElement;
  readonly show: (take: Take, state: AppState, reachable: boolean) => void;
  /** Puts a field in the place of the name. */
  readonly rename: () => void;
}

/**
 * A row of the grid of takes: star, name with settings, the letters of the comparison, rename and delete. A click
 * shows the take on the stage. Only the row that the arrows have led to is reached by Tab, with its buttons.
 */
export function createTakeRow(store: Store, id: string): TakeRow {
  const star = el(
    'button',
    {
      class: 'star',
      attributes: { type: 'button' },
      on: {
        click: () => {
          apply(store, takeStarred(id));
        },
      },
    },
    icon('star'),
  );
  const name = createTakeName(
    (text) => {
      apply(store, takeRenamed(id, text));
    },
    () => {
      root.focus();
    },
  );
  const words = el('small');
  const letters = LETTERS.map((letter) =>
    el('button', {
      text: letter,
      attributes: { type: 'button' },
      on: {
        click: () => {
          apply(store, letterGiven(id, letter));
        },
      },
    }),
  );
  const rename = action('rename', () => {
    name.edit();
  });
  const remove = action('remove', () => {
    apply(store, takeDeleted(id));
  });
  const cell = (className: string, ...parts: HTMLElement[]): HTMLElement =>
    el('div', { class: className, attributes: { role: 'gridcell' } }, ...parts);
  const root = el(
    'div',
    {
      class: 'take',
      attributes: { role: 'row', 'data-take': id },
      on: {
        click: (event) => {
          if (event.target instanceof Element && event.target.closest('button, input')) return;
          apply(store, takeChosen(id));
        },
        dblclick: (event) => {
          if (event.target instanceof Element && !event.target.closest('button')) name.edit();
        },
      },
    },
    cell('mark', star),
    cell('about', name.root, words),
    cell('acts', rename, remove),
    cell('lets', ...letters),
  );

  return {
    root,
    rename: () => {
      name.edit();
    },
    show: (take, state, reachable) => {
      const title = takeTitle(take);
      const onStage = take.reaction === state.reaction;
      name.show(title);
      setText(words, takeWords(take, state));
      words.title = allTakeWords(take);
      setAttribute(root, 'aria-selected', String(onStage));
      setAttribute(star, 'aria-pressed', String(take.starred));
      setAttribute(star, 'aria-label', `Star ${title}`);
      label(rename, `Rename ${title}`, 'Rename (F2)');
      label(remove, `Delete ${title}`, 'Delete (Del)');
      const mine = letterOf(take, state);
      LETTERS.forEach((letter, index) => {
        const button = letters[index];
        if (!button) return;
        setAttribute(button, 'aria-pressed', String(mine === letter));
        setAttribute(button, 'aria-label', `Use ${title} as ${letter}`);
        const reason = whyNoLetter(take, letter, state);
        // It stays within reach, so that the reason is.
        setAttribute(button, 'aria-disabled', reason !== null && 'true');
        button.title = reason ?? '';
      });
      for (const control of [root, star, rename, remove, ...letters]) control.tabIndex = reachable ? 0 : -1;
    },
  };
}

function action(sign: IconName, run: () => void): HTMLButtonElement {
  return el('button', { class: 'icon', attributes: { type: 'button' }, on: { click: run } }, icon(sign));
}

function label(button: HTMLButtonElement, text: string, title: string): void {
  setAttribute(button, 'aria-label', text);
  button.title = title;
}
