import { closeButton } from '../widgets/button';
import { el, returnFocusOf, UNTRANSLATED } from '../widgets/dom';
import type { Mount } from '../store/services';
import { OVERLAYS } from './overlay-menu';
import { apply, type Store, watch } from '../store/store';
import { letterKeysSet, panelToggled } from '../store/actions/view';

const KEYS: readonly (readonly [readonly string[], string])[] = [
  [['Space'], 'Play or pause'],
  [['←', '→'], 'One frame back or forward'],
  [['Shift ←', 'Shift →'], 'One bar back or forward'],
  [['Home', 'End'], 'Start, end'],
  [['[', ']'], 'Slower, faster'],
  [['← →'], 'On the song lane: move the song by one frame, with Shift by ten'],
  [['L'], 'Loop on or off'],
  [['I', 'O'], 'Loop from the beat here, to the beat here'],
  [['Alt', 'click'], 'On ruler or song: this beat is a “1”'],
  [['+', '−', '0'], 'Zoom in, out, the whole dance'],
  [['C', 'V', 'M', 'Y'], 'Coarse, fine, music, variety; then use the arrows'],
  [['R'], 'Set guidance to its default'],
  [['D'], 'Another seed'],
  [['S'], 'Star the take on the stage'],
  [['1', '2', '3'], 'Show the first, second or third reaction'],
  [['B'], 'Show the other take; hold to see it only while held'],
  [['Tab'], 'Show the other take, after a click on the stage'],
  [['Ctrl Z', 'Ctrl Y'], 'Undo, redo'],
  [['Ctrl S'], 'Save the project'],
  [['F', 'T', 'X'], 'Follow, top or side view; press again for orbit'],
  [['A'], 'Frame both dancers'],
  [[',', '.'], 'Turn the camera about the dancers'],
  [['U', 'J'], 'Camera nearer, farther'],
  [OVERLAYS.map(({ key }) => key), OVERLAYS.map(({ label }) => label).join(', ')],
  [['E'], 'Download'],
  [['Esc'], 'Cancel, close what is open, or remove the loop'],
  [['?'], 'This list'],
];

/** The list of keys. */
export const mountKeysDialog: Mount = (root, store) => {
  const close = closeButton(() => {
    apply(store, panelToggled('keys'));
  });
  const rows = KEYS.flatMap(([keys, what]) => [
    el('dt', {}, ...keys.map((key) => el('kbd', { text: key, attributes: UNTRANSLATED }))),
    el('dd', { text: what }),
  ]);
  const dialog = el(
    'section',
    { class: 'float keys', attributes: { role: 'dialog', 'aria-label': 'Keyboard shortcuts' } },
    el('div', { class: 'head' }, el('h2', { text: 'Keyboard' }), close),
    createLetterSwitch(store),
    el('dl', {}, ...rows),
  );
  dialog.hidden = true;
  root.append(dialog);
  const returnFocus = returnFocusOf(dialog);
  watch(
    store,
    (state) => state.openPanel === 'keys',
    (open) => {
      returnFocus(open);
      dialog.hidden = !open;
      if (open) close.focus();
    },
  );
};

/** Whoever speaks to the computer, or hits keys by mistake, can do without letters as shortcuts (WCAG 2.1.4). */
function createLetterSwitch(store: Store): HTMLElement {
  const box = el('input', {
    attributes: { type: 'checkbox' },
    on: {
      change: () => {
        apply(store, letterKeysSet(box.checked));
      },
    },
  });
  watch(
    store,
    (state) => state.letterKeys,
    (on) => {
      box.checked = on;
    },
  );
  return el('label', {}, box, 'Letters, digits and signs are shortcuts');
}
