import { el, together } from './dom';
import { createFader } from './fader';
import { icon } from './icons';
import type { Mount } from './services';
import type { Layer } from './state';
import { apply, guidanceReset, guidanceSet, watchAll } from './store';

const FADERS: readonly (readonly [Layer, string, string])[] = [
  ['coarse', 'Coarse', 'The big shape: path, turns, weight.'],
  ['fine', 'Fine', 'The detail: hands, feet, accents.'],
];

/** The instrument: how closely the reactor's big shape and its detail follow leader and music. */
export const mountGuidance: Mount = (root, store) => {
  const reset = el(
    'button',
    {
      class: 'icon',
      attributes: { type: 'button', 'aria-label': 'Reset guidance', title: 'Reset (R)' },
      on: {
        click: () => {
          apply(store, guidanceReset());
        },
      },
    },
    icon('reset'),
  );
  let touched: Layer | null = null;
  let worked = false;
  const faders = FADERS.map(([layer, name, hint]) => ({
    layer,
    fader: createFader(layer, name, hint, {
      change: (value) => {
        touched = layer;
        apply(store, guidanceSet(layer, value));
      },
      reset: () => {
        touched = layer;
        apply(store, guidanceReset(layer));
      },
    }),
  }));
  const section = el(
    'section',
    { class: 'sec', attributes: { 'aria-labelledby': 'guidance-head' } },
    el('div', { class: 'head' }, el('h2', { text: 'Guidance', attributes: { id: 'guidance-head' } }), reset),
    ...faders.map(({ fader }) => fader.root),
  );
  root.append(section);

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
          fader.show(settings && manifest ? manifest.guidance : null, settings?.guidance[layer] ?? 0);
          fader.setApplying(job !== null && touched === layer);
        }
      },
    ),
    () => {
      section.remove();
    },
  );
};
