import { textButton } from '../widgets/button';
import { el, setHidden, setText } from '../widgets/dom';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { apply, watchAll } from '../store/store';
import { updateSet } from '../store/actions/view';

/** Says that a newer build of the page is ready; it is not loaded by itself, since the visitor may be at work. */
export const mountNewVersion: Mount = (root, store, services) => {
  const text = el('span');
  const note = el(
    'div',
    { class: 'float update', attributes: { role: 'status' } },
    text,
    textButton('btn tint', 'Reload', () => {
      // The browser waits until the older build's service worker is idle.
      setText(text, 'The new version is loading.');
      services.loadUpdate();
    }),
    textButton(
      'btn ghost',
      'Later',
      () => {
        apply(store, updateSet(false));
      },
      { title: 'The new version loads at your next visit' },
    ),
  );
  root.append(note);
  watchAll(
    store,
    (state) => [state.update, updateText(state)],
    (state) => {
      setHidden(note, !state.update, document.querySelector('.play'));
      // Set when it is shown, so that it is read out.
      setText(text, state.update ? updateText(state) : '');
    },
  );
};

/** What is said of a newer build, also where it costs something to load it. */
export function updateText({ autosave, takes }: Pick<AppState, 'autosave' | 'takes'>): string {
  const isAtRisk = autosave !== 'stored' && takes.some(({ reaction }) => reaction.label === null);
  const ready = 'A new version is ready.';
  return isAtRisk ? `${ready} Not all takes are kept in this browser: save a project file first.` : ready;
}
