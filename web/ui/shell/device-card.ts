import { textButton, closeButton } from '../widgets/button';
import { el, onPressOutside, setOpen, setText } from '../widgets/dom';
import { byteSize, bytesOf } from '../store/format';
import type { Services } from '../store/services';
import type { ModelState } from '../store/state';
import type { StorageUsage } from '../../offline/storage-usage';
import { apply, watch, watchAll, type Store } from '../store/store';
import { panelToggled } from '../store/actions/view';
import { persistenceText } from '../store/selectors';

const PARTS = [
  ['page', 'Page and demo'],
  ['runtime', 'Runtime'],
  ['model', 'Model'],
] as const satisfies readonly (readonly [keyof StorageUsage, string])[];

interface Elements {
  readonly card: HTMLElement;
  readonly why: HTMLElement;
  readonly facts: HTMLElement;
  readonly sum: HTMLElement;
  readonly work: HTMLElement;
  readonly clear: HTMLButtonElement;
  readonly close: HTMLButtonElement;
}

/** What computes and why, and what of the page is stored on this device; it opens from the badge. */
export function mountDeviceCard(
  root: HTMLElement,
  opener: HTMLElement,
  store: Store,
  services: Services,
): void {
  const toggle = (): void => {
    apply(store, panelToggled('device'));
  };
  const elements = build(toggle, () => void empty(elements, services));
  const { card, why, work, close } = elements;
  root.append(card);
  watch(
    store,
    (state) => state.openPanel === 'device',
    (open) => {
      setOpen(card, opener, open, () => close);
    },
  );
  watchAll(
    store,
    (state) => [state.openPanel === 'device', state.model.phase],
    ({ openPanel }) => {
      if (openPanel !== 'device') return;
      void services.measureStorage().then((usage) => {
        showStorage(elements, usage, storageText(usage));
      });
    },
  );
  watch(
    store,
    ({ openPanel, model }) => (openPanel === 'device' ? reason(model) : ''),
    (sentence) => setText(why, sentence),
  );
  watch(store, persistenceText, (sentence) => {
    setText(work, sentence === null ? '' : `Your songs, leaders and takes: ${sentence}`);
    work.hidden = sentence === null;
  });
  onPressOutside([card, opener], () => {
    if (!card.hidden) toggle();
  });
}

function build(toggle: () => void, empty: () => void): Elements {
  const why = el('p', { class: 'reason' });
  const facts = el('dl', { class: 'facts' });
  const sum = el('p', { attributes: { role: 'status' } });
  const work = el('p', { class: 'reason' });
  const clear = textButton('btn tint', 'Clear', empty, {
    title: 'Removes page, runtime and model from this device',
  });
  const close = closeButton(toggle);
  const card = el(
    'section',
    { class: 'float device', attributes: { role: 'dialog', 'aria-label': 'On this device' } },
    el('div', { class: 'head' }, el('h2', { text: 'On this device' }), close),
    why,
    facts,
    el('div', { class: 'sum' }, sum, clear),
    work,
  );
  card.hidden = true;
  return { card, why, facts, sum, work, clear, close };
}

/** Bytes by part, and a sentence below them. */
function showStorage({ facts, sum, clear }: Elements, usage: StorageUsage | null, sentence: string): void {
  facts.replaceChildren(
    ...PARTS.flatMap(([part, name]) => [
      el('dt', { text: name }),
      el('dd', { text: usage && usage[part] > 0 ? byteSize(usage[part]) : 'not kept' }),
    ]),
  );
  clear.disabled = totalBytes(usage) === 0;
  setText(sum, sentence);
}

/** Removes what is stored and says whether that worked. */
async function empty(elements: Elements, services: Services): Promise<void> {
  elements.clear.disabled = true;
  const cleared = await services.clearStorage();
  showStorage(
    elements,
    await services.measureStorage(),
    cleared
      ? 'Cleared. The next visit downloads it again; nothing of yours was removed.'
      : 'The browser did not let this page clear it. You can do so in the browser’s settings for this site.',
  );
  elements.close.focus();
}

function reason(model: ModelState): string {
  if (model.phase === 'ready') return `The partner is computed on this device. ${model.reason}`;
  if (model.phase === 'loading') {
    const { label, received, total } = model;
    const now = total > 0 ? `Its model is being downloaded: ${bytesOf(received, total)}.` : `${label}.`;
    return `The partner will be computed on this device. ${now}`;
  }
  return 'The model that makes the partner could not be loaded.';
}

function storageText(usage: StorageUsage | null): string {
  if (!usage) return 'This browser gives the page no storage: each visit downloads everything.';
  const bytes = totalBytes(usage);
  return bytes > 0 ? `${byteSize(bytes)} kept for offline use` : 'Nothing is kept for offline use.';
}

function totalBytes(usage: StorageUsage | null): number {
  return usage ? usage.page + usage.runtime + usage.model : 0;
}
