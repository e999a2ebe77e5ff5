import { textButton } from '../widgets/button';
import { el, setAttribute, UNTRANSLATED } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { AppState, Compare, Letter } from '../store/state';
import { apply, type Store, watchAll } from '../store/store';
import { compareSet, takesSwapped } from '../store/actions/takes';
import { otherTake } from '../store/take';

/** A key held at least this long flips back when it is released. */
const HOLD_MS = 350;

const LETTERS: readonly Letter[] = ['A', 'B'];
const MODES: readonly (readonly [Exclude<Compare, 'off'>, string])[] = [
  ['ghost', 'Ghost'],
  ['side', 'Side by side'],
];

/** A group of buttons and how it follows the state. */
interface Group {
  readonly root: HTMLElement;
  readonly show: (state: AppState) => void;
}

/**
 * The switch over the stage while two takes are compared: which of them is on the stage, and whether the other one is
 * drawn too. Key B flips; held, it shows the other take until it is released.
 * @param drawn whether the stage can draw the other take
 */
export const mountCompareSwitch =
  (drawn: boolean): Mount =>
  (root, store) => {
    const letters = createLetters(store);
    const modes = createModes(store);
    modes.root.hidden = !drawn;
    const bar = el('div', { class: 'over compare-switch' }, letters.root, modes.root);
    root.append(bar);
    flipByKey(store);
    watchAll(
      store,
      (state) => [otherTake(state), state.letter, state.compare],
      (state) => {
        bar.hidden = otherTake(state) === null;
        letters.show(state);
        modes.show(state);
      },
    );
  };

/** Which of the two takes is on the stage. */
function createLetters(store: Store): Group {
  const buttons = LETTERS.map((letter) =>
    el('button', {
      text: letter,
      attributes: { type: 'button', role: 'radio', title: 'Show the other take (B)', ...UNTRANSLATED },
      on: {
        click: () => {
          if (store.getState().letter !== letter) apply(store, takesSwapped());
        },
        keydown: (event) => {
          if (!/^Arrow/.test(event.key)) return;
          event.preventDefault();
          event.stopPropagation();
          apply(store, takesSwapped());
          buttons[LETTERS.indexOf(store.getState().letter)]?.focus();
        },
      },
    }),
  );
  const attributes = { role: 'radiogroup', 'aria-label': 'Compare takes' };
  return {
    root: el('div', { class: 'seg', attributes }, ...buttons),
    show: ({ letter }) => {
      buttons.forEach((button, index) => {
        const chosen = LETTERS[index] === letter;
        setAttribute(button, 'aria-checked', String(chosen));
        button.tabIndex = chosen ? 0 : -1;
      });
    },
  };
}

/** How the other take is drawn; pressed again, a mode is switched off. */
function createModes(store: Store): Group {
  const buttons = MODES.map(([mode, text]) =>
    textButton('desk', text, () => {
      apply(store, compareSet(mode));
    }),
  );
  const attributes = { role: 'group', 'aria-label': 'Show both takes' };
  return {
    root: el('div', { class: 'seg', attributes }, ...buttons),
    show: ({ compare }) => {
      buttons.forEach((button, index) => {
        setAttribute(button, 'aria-pressed', String(MODES[index]?.[0] === compare));
      });
    },
  };
}

/** Flips the two takes when B is pressed, and back when it is released after a long press. */
function flipByKey(store: Store): void {
  let pressedAt: number | null = null;
  const isB = ({ key }: KeyboardEvent): boolean => key.toLowerCase() === 'b';
  window.addEventListener('keydown', (event) => {
    if (!isB(event) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.repeat || pressedAt !== null || isTyping(event) || !store.getState().letterKeys) return;
    const before = store.getState().reaction;
    apply(store, takesSwapped());
    if (store.getState().reaction !== before) pressedAt = event.timeStamp;
  });
  window.addEventListener('keyup', (event) => {
    if (!isB(event) || pressedAt === null) return;
    if (event.timeStamp - pressedAt >= HOLD_MS) apply(store, takesSwapped());
    pressedAt = null;
  });
  window.addEventListener('blur', () => {
    pressedAt = null;
  });
}

/** Whether the key goes to a field that takes letters. */
function isTyping({ target }: KeyboardEvent): boolean {
  return target instanceof Element && target.matches('input:not([type="range"]), select, textarea');
}
