import type { Manifest } from '../../model/client';
import { el, setText, together } from '../widgets/dom';
import { columnOf, guidanceAt } from '../store/guidance-matrix';
import { icon } from '../widgets/icons';
import { createMiniFader, type MiniFader } from './mini-fader';
import type { Mount } from '../store/services';
import { guidanceCellReset, guidanceCellSet } from '../store/actions/settings';
import { apply, watch, watchAll } from '../store/store';

/** The streams in words; a model of other streams shows their own names. */
const PARTS: Readonly<Record<string, { name: string; label: string; hint: string }>> = {
  upper: { name: 'Upper', label: 'Upper body', hint: 'Arms, head and trunk.' },
  lower: { name: 'Lower', label: 'Lower body', hint: 'Hips, legs and feet.' },
  placement: { name: 'Placement', label: 'Placement', hint: 'Where the dancer stands beside the other.' },
};

/** Guidance by body part, folded away until someone wants it: a small fader for each part and layer. */
export const mountMatrix: Mount = (root, store) => {
  const state = el('small');
  const fold = el(
    'button',
    {
      class: 'disc',
      attributes: {
        type: 'button',
        'aria-expanded': 'false',
        'aria-controls': 'guidance-matrix',
        title: 'Guide arms and trunk, legs, and the place on the floor each for itself',
      },
      on: {
        click: () => {
          grid.hidden = !grid.hidden;
          fold.setAttribute('aria-expanded', String(!grid.hidden));
        },
      },
    },
    icon('unfold'),
    el('span', { text: 'By body part' }),
    state,
  );
  const grid = el('div', {
    class: 'matrix',
    attributes: { id: 'guidance-matrix', role: 'group', 'aria-label': 'Guidance by body part' },
  });
  grid.hidden = true;
  root.append(fold, grid);

  let cells: { stream: string; layer: string; fader: MiniFader }[] = [];
  const build = (manifest: Manifest): void => {
    const { streams, layers } = manifest.latent;
    cells = streams.flatMap((stream) =>
      layers.map((layer) => {
        const part = PARTS[stream];
        const fader = createMiniFader(`${part?.label ?? stream}, ${layer}`, part?.hint ?? '', {
          change: (value) => {
            apply(store, guidanceCellSet(stream, layer, value));
          },
          reset: () => {
            apply(store, guidanceCellReset(stream, layer));
          },
        });
        return { stream, layer, fader };
      }),
    );
    grid.style.setProperty('--columns', String(layers.length));
    grid.replaceChildren(
      el('i'),
      ...layers.map((layer) => el('i', { text: layer.charAt(0).toUpperCase() + layer.slice(1) })),
      ...streams.flatMap((stream) => [
        el('span', { text: PARTS[stream]?.name ?? stream, attributes: { title: PARTS[stream]?.hint } }),
        ...cells.filter((cell) => cell.stream === stream).map(({ fader }) => fader.root),
      ]),
    );
  };
  return together(
    watch(
      store,
      ({ manifest }) => manifest,
      (manifest) => {
        if (manifest) build(manifest);
      },
    ),
    watchAll(
      store,
      ({ settings, manifest }) => [settings?.guidance, manifest],
      ({ settings, manifest }) => {
        fold.disabled = !settings;
        if (!settings || !manifest) return;
        const mixed = (['coarse', 'fine'] as const).some((layer) => columnOf(settings.guidance, layer).mixed);
        setText(state, mixed ? 'Mixed' : 'Same for all');
        for (const { stream, layer, fader } of cells)
          fader.show(manifest.guidance, guidanceAt(settings.guidance, stream, layer));
      },
    ),
    () => {
      fold.remove();
      grid.remove();
    },
  );
};
