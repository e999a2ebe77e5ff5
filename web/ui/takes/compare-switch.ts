import { el, listen, setAttribute, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { Compare, Letter } from '../store/state';
import { apply, watchAll } from '../store/store';
import { compareSet, takesSwapped } from '../store/actions/takes';
import { otherTake } from '../store/take';

/** A key that is held this long is a look at the other take, not a change to it, milliseconds. */
const HELD = 350;

const LETTERS: readonly Letter[] = ['A', 'B'];
const WAYS: readonly (readonly [Exclude<Compare, 'off'>, string])[] = [
  ['ghost', 'Ghost'],
  ['side', 'Side by side'],
];

/**
 * The switch over the stage while two takes are compared: which of them is shown, and whether the other one is seen
 * too. Key B flips; held, it shows the other take until it is let go.
 * @param drawn whether the stage can draw the other take
 */
export const mountCompareSwitch =
  (drawn: boolean): Mount =>
  (root, store) => {
    const letters = LETTERS.map((letter) =>
      el('button', {
        text: letter,
        attributes: { type: 'button', role: 'radio', title: 'Flip (B)' },
        on: {
          click: () => {
            if (store.getState().letter !== letter) apply(store, takesSwapped());
          },
          keydown: (event) => {
            if (!/^Arrow/.test(event.key)) return;
            event.preventDefault();
            event.stopPropagation();
            apply(store, takesSwapped());
            letters[LETTERS.indexOf(store.getState().letter)]?.focus();
          },
        },
      }),
    );
    const ways = WAYS.map(([way, text]) =>
      el('button', {
        class: 'desk',
        text,
        attributes: { type: 'button' },
        on: {
          click: () => {
            apply(store, compareSet(way));
          },
        },
      }),
    );
    const group = el(
      'div',
      { class: 'seg', attributes: { role: 'radiogroup', 'aria-label': 'Compare takes' } },
      ...letters,
    );
    const seen = el(
      'div',
      { class: 'seg', attributes: { role: 'group', 'aria-label': 'Show both takes' } },
      ...ways,
    );
    seen.hidden = !drawn;
    const bar = el('div', { class: 'over ab' }, group, seen);
    root.append(bar);

    let pressed: number | null = null;
    const types = (event: KeyboardEvent): boolean =>
      event.target instanceof Element && event.target.matches('input:not([type="range"]), select, textarea');
    return together(
      listen(window, 'keydown', (event) => {
        if (event.key.toLowerCase() !== 'b' || event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.repeat || pressed !== null || types(event)) return;
        const before = store.getState().reaction;
        apply(store, takesSwapped());
        if (store.getState().reaction !== before) pressed = event.timeStamp;
      }),
      listen(window, 'keyup', (event) => {
        if (event.key.toLowerCase() !== 'b' || pressed === null) return;
        if (event.timeStamp - pressed >= HELD) apply(store, takesSwapped());
        pressed = null;
      }),
      listen(window, 'blur', () => {
        pressed = null;
      }),
      watchAll(
        store,
        (state) => [otherTake(state), state.letter, state.compare],
        (state) => {
          const { letter, compare } = state;
          bar.hidden = otherTake(state) === null;
          LETTERS.forEach((name, index) => {
            const button = letters[index];
            if (!button) return;
            setAttribute(button, 'aria-checked', String(name === letter));
            button.tabIndex = name === letter ? 0 : -1;
          });
          WAYS.forEach(([way], index) => {
            const button = ways[index];
            if (button) setAttribute(button, 'aria-pressed', String(way === compare));
          });
        },
      ),
      () => {
        bar.remove();
      },
    );
  };
