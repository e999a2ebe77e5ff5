import { valueText } from '../widgets/fader';
import type { Manifest } from '../../model/client';
import { el, setText } from '../widgets/dom';
import { capitalised } from '../store/format';
import { columnOf, guidanceAt, rangeOf } from '../store/guidance-matrix';
import { icon } from '../widgets/icons';
import { createMiniFader, type MiniFader } from './mini-fader';
import type { Mount } from '../store/services';
import type { Guidance } from '../store/reaction';
import { clickContinued, guidanceCellReset, guidanceCellSet } from '../store/actions/settings';
import { apply, type Store, watch, watchAll } from '../store/store';

/** Names of the known streams; other streams are shown by their name in the manifest. */
const PARTS: Readonly<Record<string, { name: string; label: string; hint: string }>> = {
  upper: { name: 'Upper', label: 'Upper body', hint: 'Arms, head and trunk.' },
  lower: { name: 'Lower', label: 'Lower body', hint: 'Hips, legs and feet.' },
  placement: { name: 'Placement', label: 'Placement', hint: 'Where the dancer stands beside the other.' },
};

/** The fader of one stream and layer. */
interface Cell {
  readonly stream: string;
  readonly layer: string;
  readonly fader: MiniFader;
}

/** Guidance by body part, folded away at first: a small fader for each stream and layer. */
export const mountMatrix: Mount = (root, store) => {
  const summary = el('small');
  const grid = el('div', {
    class: 'matrix',
    attributes: { id: 'guidance-matrix', role: 'group', 'aria-label': 'Guidance by body part' },
  });
  grid.hidden = true;
  const fold = createFold(grid, summary);
  root.append(fold, grid);

  let cells: readonly Cell[] = [];
  watch(
    store,
    ({ manifest }) => manifest,
    (manifest) => {
      if (!manifest) return;
      cells = createCells(store, manifest);
      fillGrid(grid, manifest, cells);
    },
  );
  watchAll(
    store,
    ({ settings, manifest }) => [settings?.guidance, manifest],
    ({ settings, manifest }) => {
      fold.disabled = !settings;
      if (!settings || !manifest) return;
      setText(summary, isMixed(settings.guidance) ? 'Mixed' : 'Same for all');
      for (const { stream, layer, fader } of cells)
        fader.show(rangeOf(manifest.guidance, layer), guidanceAt(settings.guidance, stream, layer));
    },
  );
};

/** The button that shows and hides the grid. */
function createFold(grid: HTMLElement, summary: HTMLElement): HTMLButtonElement {
  const fold = el(
    'button',
    {
      class: 'disclosure',
      attributes: {
        type: 'button',
        'aria-expanded': 'false',
        'aria-controls': grid.id,
        title: 'Set arms and trunk, legs, and the place on the floor separately',
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
    summary,
  );
  return fold;
}

function createCells(store: Store, { latent }: Manifest): Cell[] {
  return latent.streams.flatMap((stream) =>
    latent.layers.map((layer) => {
      const part = PARTS[stream];
      const fader = createMiniFader(
        `${part?.label ?? stream}, ${layer}`,
        part?.hint ?? '',
        {
          change: (value) => {
            apply(store, guidanceCellSet(stream, layer, value));
          },
          reset: (clicked) => {
            if (clicked) apply(store, clickContinued());
            apply(store, guidanceCellReset(stream, layer));
          },
        },
        (value, range) => valueText(layer === 'coarse' ? 'coarse' : 'fine', value, range),
      );
      return { stream, layer, fader };
    }),
  );
}

/** A column for each layer, a row for each stream, and their names. */
function fillGrid(grid: HTMLElement, { latent }: Manifest, cells: readonly Cell[]): void {
  const { streams, layers } = latent;
  grid.style.setProperty('--columns', String(layers.length));
  grid.replaceChildren(
    el('i'),
    ...layers.map((layer) => el('i', { text: capitalised(layer) })),
    ...streams.flatMap((stream) => [
      el('span', { text: PARTS[stream]?.name ?? stream, attributes: { title: PARTS[stream]?.hint } }),
      ...cells.filter((cell) => cell.stream === stream).map(({ fader }) => fader.root),
    ]),
  );
}

/** Whether the streams differ in one of the layers. */
function isMixed(guidance: Guidance): boolean {
  return (['coarse', 'fine'] as const).some((layer) => columnOf(guidance, layer).mixed);
}
