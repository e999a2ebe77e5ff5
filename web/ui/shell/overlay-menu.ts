import { besideStage, coarseIsMissing } from '../generation/coarse-layer';
import { el, setAttribute, setText, combineDisposers } from '../widgets/dom';
import type { Mount, Services } from '../store/services';
import type { VisibleOverlays } from '../../common/visible-overlays';
import type { Reaction } from '../store/reaction';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';
import { mountTakesButton } from '../takes/takes-panel';
import { panelToggled, overlayToggled } from '../store/actions/view';

/** Something the stage can draw in addition to the dancers: its name on the page, the key that toggles it, a hint. */
interface Overlay {
  readonly what: keyof VisibleOverlays;
  readonly label: string;
  readonly key: string;
  readonly hint: string;
}

export const OVERLAYS: readonly Overlay[] = [
  { what: 'ghost', label: 'Coarse ghost', key: 'G', hint: 'The partner without the fine layer' },
  { what: 'skeleton', label: 'Skeleton', key: 'K', hint: 'Bones and joints inside the bodies' },
  { what: 'trails', label: 'Trails', key: 'P', hint: 'Where hands and feet have just been' },
  { what: 'contacts', label: 'Foot contacts', key: 'N', hint: 'Rings under feet that stand' },
  { what: 'facing', label: 'Facing', key: 'W', hint: 'Which way each dancer faces' },
  { what: 'hands', label: 'Hand links', key: 'H', hint: 'Lines between hands within reach' },
];

interface Elements {
  readonly corner: HTMLElement;
  readonly button: HTMLButtonElement;
  /** How many overlays are on. */
  readonly count: HTMLElement;
  readonly menu: HTMLElement;
  /** One per overlay, in their order. */
  readonly toggles: readonly HTMLButtonElement[];
  /** Says why the coarse ghost can't be seen, with a button that generates it. */
  readonly note: HTMLElement;
  readonly noteText: HTMLElement;
  readonly generate: HTMLButtonElement;
}

/** The button on the stage and its menu: what is drawn beside the dancers. */
export const mountOverlayMenu: Mount = (root, store, services) => {
  const elements = build(store, services);
  const { corner, menu } = elements;
  root.append(corner);
  const takes = mountTakesButton(corner, store, services);
  const closeOutside = (event: PointerEvent): void => {
    if (!menu.hidden && !corner.contains(event.target as Node)) apply(store, panelToggled('overlays'));
  };
  document.addEventListener('pointerdown', closeOutside);
  return combineDisposers(
    watchAll(
      store,
      (state) => [state.overlays, state.coarse, state.reaction, besideStage(state), state.job === null],
      (state) => {
        showState(elements, state);
      },
    ),
    watch(
      store,
      (state) => state.openPanel === 'overlays',
      (open) => {
        showOpen(elements, open);
      },
    ),
    takes,
    () => {
      document.removeEventListener('pointerdown', closeOutside);
      corner.remove();
    },
  );
};

function build(store: Store, services: Services): Elements {
  const count = el('span', { class: 'count-on' });
  const toggleMenu = (): void => {
    apply(store, panelToggled('overlays'));
  };
  const button = el(
    'button',
    { class: 'btn', attributes: { type: 'button', 'aria-haspopup': 'dialog' }, on: { click: toggleMenu } },
    'Show',
    count,
  );
  const toggles = OVERLAYS.map((overlay) =>
    overlayToggle(overlay, () => {
      apply(store, overlayToggled(overlay.what));
    }),
  );
  const generate = el('button', {
    class: 'btn',
    text: 'Generate it here',
    attributes: { type: 'button' },
    on: {
      click: () => {
        services.generate();
      },
    },
  });
  const noteText = el('span');
  const note = el('div', { class: 'note' }, noteText, generate);
  const [ghost, ...others] = toggles;
  const menu = el(
    'div',
    { class: 'float overlay-menu', attributes: { role: 'dialog', 'aria-label': 'Show on the stage' } },
    ghost ?? null,
    note,
    ...others,
  );
  menu.hidden = true;
  const corner = el('div', { class: 'over stage-corner' }, button, menu);
  return { corner, button, count, menu, toggles, note, noteText, generate };
}

function overlayToggle({ label, key, hint }: Overlay, toggle: () => void): HTMLButtonElement {
  return el(
    'button',
    {
      class: 'menu-item',
      attributes: { type: 'button', title: hint, 'aria-keyshortcuts': key, 'aria-label': label },
      on: { click: toggle },
    },
    el('span', { class: 'indicator', attributes: { 'aria-hidden': true } }),
    el('span', { class: 'name', text: label }),
    el('kbd', { class: 'desk', text: key, attributes: { 'aria-hidden': true } }),
  );
}

function showState({ button, count, toggles, note, noteText, generate }: Elements, state: AppState): void {
  const { overlays, coarse, job } = state;
  OVERLAYS.forEach(({ what }, i) => {
    const toggle = toggles[i]!;
    setAttribute(toggle, 'aria-pressed', String(overlays[what]));
    if (what === 'ghost') setAttribute(toggle, 'aria-busy', coarse.decoding ? 'true' : undefined);
  });
  const on = OVERLAYS.filter(({ what }) => overlays[what]).length;
  setText(count, on > 0 ? String(on) : '');
  button.setAttribute('aria-label', on > 0 ? `Show, ${on} on` : 'Show');
  const text = ghostNote(state);
  note.hidden = text === '';
  setText(noteText, text);
  generate.hidden = !coarseIsMissing(state) || job !== null;
}

function showOpen({ button, menu, toggles }: Elements, open: boolean): void {
  const wasOpen = !menu.hidden;
  menu.hidden = !open;
  button.setAttribute('aria-expanded', String(open));
  if (open) toggles[0]?.focus();
  else if (wasOpen && menu.contains(document.activeElement)) button.focus();
}

/** Why the coarse ghost can't be seen; empty when it can. */
function ghostNote(state: AppState): string {
  const { reaction, coarse, job } = state;
  if (reaction && coarseIsMissing(state)) return job ? 'Being generated' : missingText(reaction);
  if (coarse.decoding) return 'Decoding the coarse layer';
  const beside = besideStage(state);
  return beside && coarseIsMissing({ reaction: beside }) ? `Beside it: ${missingText(beside)}` : '';
}

function missingText({ label }: Reaction): string {
  return label === null
    ? 'This take was made by another model, or stored without its coarse layer.'
    : `The ${label} has no coarse layer to show.`;
}
