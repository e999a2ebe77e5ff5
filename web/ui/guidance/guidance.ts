import { iconButton } from '../widgets/button';
import { el, combineDisposers } from '../widgets/dom';
import { createFader } from '../widgets/fader';
import { columnOf, rangeOf } from '../store/guidance-matrix';
import { mountMatrix } from './matrix';
import { mountMusicFader } from './music-fader';
import { mountPresetMenu } from './preset-menu';
import type { Mount } from '../store/services';
import type { Guidance, Layer } from '../store/reaction';
import type { AppState } from '../store/state';
import { guidanceReset, guidanceSet } from '../store/actions/settings';
import { apply, type Store, watchAll } from '../store/store';

const FADERS: readonly (readonly [Layer, string, string])[] = [
  ['coarse', 'Coarse', 'The big shape: path, turns, weight.'],
  ['fine', 'Fine', 'The detail: hands, feet, accents.'],
];

/** The section of classifier-free guidance: presets, a fader for each layer, one for the music, and body parts. */
export const mountGuidance: Mount = (root, store, services) => {
  const reset = iconButton(
    'icon',
    'reset',
    { label: 'Reset guidance', title: 'Back to what suits this model best (R)' },
    () => {
      apply(store, guidanceReset());
    },
  );
  const faders = createLayerFaders(store);
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
  const menu = mountPresetMenu(head, store, services);
  head.append(reset);
  const music = mountMusicFader(section, store, services);
  const matrix = mountMatrix(section, store, services);

  return combineDisposers(
    watchAll(
      store,
      (state) => [state.settings, state.manifest, state.job !== null],
      (state) => {
        reset.disabled = !state.settings;
        faders.show(state);
      },
    ),
    menu,
    music,
    matrix,
    () => {
      section.remove();
    },
  );
};

/** A fader for each layer; it sets the mean over the body parts and is outlined while its change is being applied. */
function createLayerFaders(store: Store): {
  readonly elements: readonly HTMLElement[];
  readonly show: (state: AppState) => void;
} {
  /** The fader that was moved last, until the job that it caused has ended. */
  let changed: Layer | null = null;
  let hadJob = false;
  /** Guidance at the start of a drag: while it lasts, the differences between body parts are taken from here. */
  let beforeDrag: Guidance | null = null;
  const faders = FADERS.map(([layer, name, hint]) => ({
    layer,
    fader: createFader(layer, name, hint, {
      change: (value) => {
        changed = layer;
        apply(store, guidanceSet(layer, value, beforeDrag ?? undefined));
      },
      reset: () => {
        changed = layer;
        apply(store, guidanceReset(layer));
      },
      grab: () => {
        beforeDrag = store.getState().settings?.guidance ?? null;
      },
      release: () => {
        beforeDrag = null;
      },
    }),
  }));
  return {
    elements: faders.map(({ fader }) => fader.root),
    show: ({ settings, manifest, job }) => {
      // The job begins a moment after the fader was scrolled, so only its end counts.
      if (hadJob && !job) changed = null;
      hadJob = job !== null;
      for (const { layer, fader } of faders) {
        const { value, mixed } = columnOf(settings?.guidance ?? {}, layer);
        fader.show(settings && manifest ? rangeOf(manifest.guidance, layer) : null, value, mixed);
        fader.setApplying(job !== null && changed === layer);
      }
    },
  };
}
