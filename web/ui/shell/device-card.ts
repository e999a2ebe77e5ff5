import { closeButton } from '../widgets/close-button';
import { el, setText, together } from '../widgets/dom';
import { byteSize } from '../store/format';
import type { Services } from '../store/services';
import type { Kept, ModelState } from '../store/state';
import { apply, watch, watchAll, type Store } from '../store/store';
import { opened } from '../store/actions/view';

const PARTS = [
  ['page', 'Page and demo'],
  ['runtime', 'Runtime'],
  ['model', 'Model'],
] as const satisfies readonly (readonly [keyof Kept, string])[];

/** What computes and why, and what of it is kept on this device; it opens from the badge. */
export function mountDeviceCard(
  root: HTMLElement,
  opener: HTMLElement,
  store: Store,
  services: Services,
): () => void {
  const why = el('p', { class: 'reason' });
  const facts = el('dl', { class: 'facts' });
  const sum = el('p', { attributes: { role: 'status' } });
  const clear = el('button', {
    class: 'btn tint',
    text: 'Clear',
    attributes: { type: 'button', title: 'Removes page, runtime and model from this device' },
    on: {
      click: () => {
        void empty();
      },
    },
  });
  const close = closeButton(() => {
    apply(store, opened('device'));
  });
  const card = el(
    'section',
    { class: 'float device', attributes: { role: 'dialog', 'aria-label': 'On this device' } },
    el('div', { class: 'head' }, el('h2', { text: 'On this device' }), close),
    why,
    facts,
    el('div', { class: 'sum' }, sum, clear),
  );
  card.hidden = true;
  root.append(card);

  /** `after` is said instead when something was just done. */
  const show = (kept: Kept | null, after?: string): void => {
    facts.replaceChildren(
      ...PARTS.flatMap(([part, name]) => [
        el('dt', { text: name }),
        el('dd', { text: kept && kept[part] > 0 ? byteSize(kept[part]) : 'not kept' }),
      ]),
    );
    const bytes = kept ? kept.page + kept.runtime + kept.model : 0;
    clear.disabled = bytes === 0;
    setText(sum, after ?? keptWords(kept));
  };
  const measure = async (): Promise<void> => {
    show(await services.measureKept());
  };
  const empty = async (): Promise<void> => {
    clear.disabled = true;
    const cleared = await services.clearKept();
    show(
      await services.measureKept(),
      cleared
        ? 'Cleared. The next visit downloads it again; nothing of yours was removed.'
        : 'The browser did not let this page clear it. Its own settings for this site can.',
    );
    close.focus();
  };
  const closeOutside = (event: PointerEvent): void => {
    const target = event.target as Node;
    if (!card.hidden && !card.contains(target) && !opener.contains(target)) apply(store, opened('device'));
  };
  document.addEventListener('pointerdown', closeOutside);
  return together(
    watch(
      store,
      (state) => state.open === 'device',
      (open) => {
        const focusInside = card.contains(document.activeElement);
        card.hidden = !open;
        opener.setAttribute('aria-expanded', String(open));
        if (open) close.focus();
        else if (focusInside) opener.focus();
      },
    ),
    watchAll(
      store,
      (state) => [state.open === 'device', state.model.phase],
      ({ open, model }) => {
        if (open !== 'device') return;
        setText(why, reason(model));
        void measure();
      },
    ),
    () => {
      document.removeEventListener('pointerdown', closeOutside);
      card.remove();
    },
  );
}

function reason(model: ModelState): string {
  if (model.phase === 'ready') return `The partner is computed here. ${model.reason}`;
  if (model.phase === 'loading') return 'The partner will be computed here; its model is on the way.';
  return 'The partner is computed here, but its model could not be loaded.';
}

function keptWords(kept: Kept | null): string {
  if (!kept) return 'This browser gives the page no storage: each visit downloads everything.';
  const bytes = kept.page + kept.runtime + kept.model;
  return bytes > 0 ? `${byteSize(bytes)} kept for offline use` : 'Nothing is kept for offline use.';
}
