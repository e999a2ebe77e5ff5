import { el, together } from '../widgets/dom';
import { createFader } from '../widgets/fader';
import { columnOf } from '../store/guidance-matrix';
import { icon } from '../widgets/icons';
import { mountMatrix } from './matrix';
import { mountMusicFader } from './music-fader';
import { mountPresetMenu } from './preset-menu';
import type { Mount } from '../store/services';
import type { Guidance, Layer } from '../store/state';
import { guidanceReset, guidanceSet } from '../store/actions/settings';
import { apply, watchAll } from '../store/store';

const FADERS: readonly (readonly [Layer, string, string])[] = [
  ['coarse', 'Coarse', 'The big shape: path, turns, weight.'],
  ['fine', 'Fine', 'The detail: hands, feet, accents.'],
];

/** The instrument: how closely the partner's big shape and its detail follow the other dancer and the music. */
export const mountGuidance: Mount = (root, store, services) => {
  const reset = el(
    'button',
    {
      class: 'icon',
      attributes: {
        type: 'button',
        'aria-label': 'Reset guidance',
        title: 'Back to what suits this model best (R)',
      },
      on: {
        click: () => {
          apply(store, guidanceReset());
        },
      },
    },
    icon('reset'),
  );
  let touched: Layer | null = null;
  /** Where the body parts stood when a fader was taken in hand: while it is held, their differences come back. */
  let held: Guidance | null = null;
  let worked = false;
  const faders = FADERS.map(([layer, name, hint]) => ({
    layer,
    fader: createFader(layer, name, hint, {
      change: (value) => {
        touched = layer;
        apply(store, guidanceSet(layer, value, held ?? undefined));
      },
      reset: () => {
        touched = layer;
        apply(store, guidanceReset(layer));
      },
      grab: () => {
        held = store.getState().settings?.guidance ?? null;
      },
      release: () => {
        held = null;
      },
    }),
  }));
  const head = el(
    'div',
    { class: 'head' },
    el('h2', { text: 'Guidance', attributes: { id: 'guidance-head' } }),
  );
  const section = el(
    'section',
    { class: 'sec guidance', attributes: { 'aria-labelledby': 'guidance-head' } },
    head,
    ...faders.map(({ fader }) => fader.root),
  );
  root.append(section);
  const menu = mountPresetMenu(head, store, services);
  head.append(reset);
  const music = mountMusicFader(section, store, services);
  const matrix = mountMatrix(section, store, services);

  return together(
    watchAll(
      store,
      (state) => [state.settings, state.manifest, state.job !== null],
      ({ settings, manifest, job }) => {
        reset.disabled = !settings;
        // A fader is touched a moment before its job begins, and is done with when that job ends.
        if (worked && !job) touched = null;
        worked = job !== null;
        for (const { layer, fader } of faders) {
          const { value, mixed } = columnOf(settings?.guidance ?? {}, layer);
          fader.show(settings && manifest ? manifest.guidance : null, value, mixed);
          fader.setApplying(job !== null && touched === layer);
        }
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
