import { iconButton } from '../widgets/button';
import { el } from '../widgets/dom';
import { createFaders } from './faders';
import { mountMatrix } from './matrix';
import { mountPresetMenu } from './preset-menu';
import { isReading } from '../store/selectors';
import type { Mount } from '../store/services';
import { dragBegun, dragEnded, guidanceReset } from '../store/actions/settings';
import { apply, type Store, watchAll } from '../store/store';

/** The section of what shapes the dance: presets, faders for the layers, the music and the variety, and body parts. */
export const mountGuidance: Mount = (root, store, services) => {
  const reset = iconButton(
    'icon',
    'reset',
    { label: 'Reset guidance', title: 'Back to the default (R)' },
    () => {
      apply(store, guidanceReset());
    },
  );
  const faders = createFaders(store);
  const head = el(
    'div',
    { class: 'head' },
    el('h2', { text: 'Guidance', attributes: { id: 'guidance-head' } }),
  );
  const section = el(
    'section',
    { class: 'sec guidance', attributes: { 'aria-labelledby': 'guidance-head' } },
    head,
    ...faders.elements,
  );
  root.append(section);
  mountPresetMenu(head, store, services);
  head.append(reset);
  mountMatrix(section, store, services);

  watchAll(
    store,
    (state) => [
      ...[state.settings, state.manifest, state.song !== null, state.job !== null],
      ...[...isReading(state), state.restoring !== null],
    ],
    (state) => {
      reset.disabled = !state.settings;
      faders.show(state);
    },
  );
  followDrags(section, store);
};

/** Says when a fader in the section is grabbed and released; wherever the pointer is by then, the page hears of it. */
function followDrags(section: HTMLElement, store: Store): void {
  const begin = ({ target, button }: PointerEvent): void => {
    const isFader = target instanceof HTMLInputElement && target.type === 'range';
    // Another button opens a menu, which may take the release.
    if (isFader && button === 0) apply(store, dragBegun());
  };
  const end = (): void => {
    if (store.getState().drag?.held) apply(store, dragEnded());
  };
  section.addEventListener('pointerdown', begin);
  window.addEventListener('pointerup', end);
  window.addEventListener('pointercancel', end);
}
