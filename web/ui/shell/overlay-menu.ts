import { textButton } from '../widgets/button';
import { besideStage, coarseIsMissing } from '../generation/coarse-layer';
import { el, onPressOutside, setAttribute, setOpen, setText, UNTRANSLATED } from '../widgets/dom';
import type { Mount, Services } from '../store/services';
import type { VisibleOverlays } from '../../common/picture';
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
  { what: 'contacts', label: 'Foot contacts', key: 'N', hint: 'Rings under planted feet' },
  { what: 'hands', label: 'Hand links', key: 'H', hint: 'Arcs between hands within reach' },
  { what: 'trails', label: 'Trails', key: 'P', hint: 'Where hands and feet have just been' },
  { what: 'skeleton', label: 'Skeleton', key: 'K', hint: 'Bones and joints inside the bodies' },
  { what: 'facing', label: 'Facing', key: 'W', hint: 'Which way each dancer faces' },
];

/** Toggles an overlay. A coarse ghost that can't be drawn opens the menu, which says why and what to do. */
export function toggleOverlay(store: Store, what: keyof VisibleOverlays): void {
  apply(store, overlayToggled(what));
  const { overlays, openPanel, firstVisit } = store.getState();
  const isMissing = what === 'ghost' && overlays.ghost && coarseIsMissing(store.getState());
  if (isMissing && openPanel === null && !firstVisit) apply(store, panelToggled('overlays'));
}

interface Elements {
  readonly corner: HTMLElement;
  readonly button: HTMLButtonElement;
  /** How many overlays are on. */
  readonly count: HTMLElement;
  readonly menu: HTMLElement;
  /** In the menu and on the stage, one per overlay each, in their order. */
  readonly toggles: readonly (readonly HTMLButtonElement[])[];
  /** Says why the coarse ghost can't be seen, with a button that generates it. */
  readonly note: HTMLElement;
  readonly noteText: HTMLElement;
  readonly generate: HTMLButtonElement;
}

/** What is drawn beside the dancers: toggles on the stage, and a button with a menu where the stage is narrow. */
export const mountOverlayMenu: Mount = (root, store, services) => {
  const elements = build(store, services);
  const { corner, button, menu, toggles } = elements;
  root.append(corner);
  mountTakesButton(corner, store, services);
  watchAll(
    store,
    (state) => [state.overlays, state.coarse, state.reaction, besideStage(state), state.job === null],
    (state) => {
      showState(elements, state);
    },
  );
  watch(
    store,
    (state) => state.openPanel === 'overlays',
    (open) => {
      setOpen(menu, button, open, () => toggles[0]?.find((toggle) => toggle.checkVisibility()));
    },
  );
  onPressOutside([menu, button], () => {
    if (!menu.hidden) apply(store, panelToggled('overlays'));
  });
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
  const togglesOf = (className: string): HTMLButtonElement[] =>
    OVERLAYS.map((overlay) =>
      overlayToggle(overlay, className, () => {
        toggleOverlay(store, overlay.what);
      }),
    );
  const inMenu = togglesOf('menu-item');
  const onStage = togglesOf('btn stage-toggle');
  const generate = textButton('btn', 'Generate it here', services.generate);
  const noteText = el('span');
  const note = el('div', { class: 'note' }, noteText, generate);
  const [ghost, ...others] = inMenu;
  const menu = el(
    'div',
    { class: 'float overlay-menu', attributes: { role: 'dialog', 'aria-label': 'Show on the stage' } },
    ghost ?? null,
    note,
    ...others,
  );
  menu.hidden = true;
  // Seen where the stage is wide: all, or the first three beside the button of the menu.
  const row = el(
    'div',
    { class: 'stage-toggles', attributes: { role: 'group', 'aria-label': 'Shown on the stage' } },
    ...onStage,
  );
  const corner = el('div', { class: 'over stage-corner' }, row, button, menu);
  return { corner, button, count, menu, toggles: [inMenu, onStage], note, noteText, generate };
}

function overlayToggle(
  { label, key, hint }: Overlay,
  className: string,
  toggle: () => void,
): HTMLButtonElement {
  return el(
    'button',
    {
      class: className,
      attributes: { type: 'button', title: hint, 'aria-keyshortcuts': key, 'aria-label': label },
      on: { click: toggle },
    },
    el('span', { class: 'indicator', attributes: { 'aria-hidden': true } }),
    el('span', { class: 'name', text: label }),
    el('kbd', { class: 'desk', text: key, attributes: { 'aria-hidden': true, ...UNTRANSLATED } }),
  );
}

function showState({ button, count, toggles, note, noteText, generate }: Elements, state: AppState): void {
  const { overlays, coarse, job } = state;
  OVERLAYS.forEach(({ what }, i) => {
    for (const place of toggles) {
      const toggle = place[i]!;
      setAttribute(toggle, 'aria-pressed', String(overlays[what]));
      if (what === 'ghost') setAttribute(toggle, 'aria-busy', coarse.decoding ? 'true' : undefined);
    }
  });
  const on = OVERLAYS.filter(({ what }) => overlays[what]).length;
  setText(count, on > 0 ? String(on) : '');
  button.setAttribute('aria-label', on > 0 ? `Show, ${on} on` : 'Show');
  const text = ghostNote(state);
  note.hidden = text === '';
  setText(noteText, text);
  generate.hidden = !coarseIsMissing(state) || job !== null;
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
