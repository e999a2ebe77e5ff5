import { iconButton, textButton } from '../widgets/button';
import { el, setAttribute, setText, UNTRANSLATED } from '../widgets/dom';
import type { Take } from '../store/reaction';
import type { AppState, Letter } from '../store/state';
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
import { fullTakeText, takeText } from './take-text';

const LETTERS: readonly Letter[] = ['A', 'B'];

/** One take in the list. */
export interface TakeRow {
  readonly root: HTMLElement;
  /** @param tabStop whether Tab leads to this row and its buttons */
  readonly show: (take: Take, state: AppState, tabStop: boolean) => void;
  /** Puts a field in the place of the name. */
  readonly rename: () => void;
}

/**
 * A row of the grid of takes: star, name with settings, rename and delete, the letters of the comparison. A click
 * shows the take on the stage, a double click renames it.
 */
export function createTakeRow(store: Store, id: string): TakeRow {
  const star = iconButton('star', 'star', {}, () => {
    apply(store, takeStarred(id));
  });
  const name = createTakeName(
    (text) => {
      apply(store, takeRenamed(id, text));
    },
    () => {
      root.focus();
    },
  );
  const details = el('small');
  const rename = iconButton('icon', 'rename', {}, name.edit);
  const remove = iconButton('icon', 'remove', {}, ({ detail }) => {
    // After the first click of a double click the next take is under the pointer.
    if (detail < 2) apply(store, takeDeleted(id));
  });
  const letters = createLetterButtons(store, id);
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
          if (event.target instanceof Element && !event.target.closest('button, input')) name.edit();
        },
      },
    },
    cell('mark', star),
    cell('about', name.root, details),
    cell('actions', rename, remove),
    cell('letters', ...letters),
  );
  return {
    root,
    rename: name.edit,
    show: (take, state, tabStop) => {
      const title = takeTitle(take);
      name.show(title);
      setText(details, takeText(take, state));
      details.title = fullTakeText(take);
      setAttribute(root, 'aria-selected', String(take.reaction === state.reaction));
      setAttribute(star, 'aria-pressed', String(take.starred));
      setAttribute(star, 'aria-label', `Star ${title}`);
      setLabel(rename, `Rename ${title}`, 'Rename (F2)');
      setLabel(remove, `Delete ${title}`, 'Delete (Del)');
      showLetters(letters, take, state);
      for (const control of [root, star, rename, remove, ...letters]) control.tabIndex = tabStop ? 0 : -1;
    },
  };
}

function cell(className: string, ...children: HTMLElement[]): HTMLElement {
  return el('div', { class: className, attributes: { role: 'gridcell' } }, ...children);
}

/** The buttons that make the take A or B of the comparison, in this order. */
function createLetterButtons(store: Store, id: string): HTMLButtonElement[] {
  return LETTERS.map((letter) =>
    textButton(
      '',
      letter,
      () => {
        apply(store, letterGiven(id, letter));
      },
      UNTRANSLATED,
    ),
  );
}

function showLetters(buttons: readonly HTMLButtonElement[], take: Take, state: AppState): void {
  const current = letterOf(take, state);
  LETTERS.forEach((letter, index) => {
    const button = buttons[index];
    if (!button) return;
    setAttribute(button, 'aria-pressed', String(current === letter));
    setAttribute(button, 'aria-label', `Use ${takeTitle(take)} as ${letter}`);
    const reason = whyNoLetter(take, letter, state);
    // Not `disabled`: the button can still have focus and pointer, so that its tooltip tells the reason.
    setAttribute(button, 'aria-disabled', reason !== null && 'true');
    button.title = reason ?? '';
  });
}

function setLabel(button: HTMLButtonElement, label: string, title: string): void {
  setAttribute(button, 'aria-label', label);
  button.title = title;
}
