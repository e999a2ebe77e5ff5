import { besideStage, coarseIsMissing } from '../generation/coarse-layer';
import { el, setAttribute, setText, together } from '../widgets/dom';
import type { Mount, Services } from '../store/services';
import { SHOWS, type ShowWords } from '../store/overlays';
import type { AppState, Reaction } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';
import { mountTakesDoor } from '../takes/takes-button';
import { opened, shownToggled } from '../store/actions/view';

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
export const mountShowMenu: Mount = (root, store, services) => {
  const elements = build(store, services);
  const { corner, menu } = elements;
  root.append(corner);
  const takes = mountTakesDoor(corner, store, services);
  const closeOutside = (event: PointerEvent): void => {
    if (!menu.hidden && !corner.contains(event.target as Node)) apply(store, opened('show'));
  };
  document.addEventListener('pointerdown', closeOutside);
  return together(
    watchAll(
      store,
      (state) => [state.shown, state.coarse, state.reaction, besideStage(state), state.job === null],
      (state) => {
        showState(elements, state);
      },
    ),
    watch(
      store,
      (state) => state.open === 'show',
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
    apply(store, opened('show'));
  };
  const button = el(
    'button',
    { class: 'btn', attributes: { type: 'button', 'aria-haspopup': 'dialog' }, on: { click: toggleMenu } },
    'Show',
    count,
  );
  const toggles = SHOWS.map((overlay) =>
    overlayToggle(overlay, () => {
      apply(store, shownToggled(overlay.what));
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
    { class: 'float show', attributes: { role: 'dialog', 'aria-label': 'Show on the stage' } },
    ghost ?? null,
    note,
    ...others,
  );
  menu.hidden = true;
  const corner = el('div', { class: 'over shows' }, button, menu);
  return { corner, button, count, menu, toggles, note, noteText, generate };
}

function overlayToggle({ label, key, hint }: ShowWords, toggle: () => void): HTMLButtonElement {
  return el(
    'button',
    {
      class: 'it',
      attributes: { type: 'button', title: hint, 'aria-keyshortcuts': key, 'aria-label': label },
      on: { click: toggle },
    },
    el('span', { class: 'led', attributes: { 'aria-hidden': true } }),
    el('span', { class: 'name', text: label }),
    el('kbd', { class: 'desk', text: key, attributes: { 'aria-hidden': true } }),
  );
}

function showState({ button, count, toggles, note, noteText, generate }: Elements, state: AppState): void {
  const { shown, coarse, job } = state;
  SHOWS.forEach(({ what }, i) => {
    const toggle = toggles[i]!;
    setAttribute(toggle, 'aria-pressed', String(shown[what]));
    if (what === 'ghost') setAttribute(toggle, 'aria-busy', coarse.decoding ? 'true' : undefined);
  });
  const on = SHOWS.filter(({ what }) => shown[what]).length;
  setText(count, on > 0 ? String(on) : '');
  button.setAttribute('aria-label', on > 0 ? `Show, ${on} on` : 'Show');
  const words = noteWords(state);
  note.hidden = words === '';
  setText(noteText, words);
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
function noteWords(state: AppState): string {
  const { reaction, coarse, job } = state;
  if (reaction && coarseIsMissing(state)) return job ? 'Being generated' : missingWords(reaction);
  if (coarse.decoding) return 'Decoding the coarse layer';
  const beside = besideStage(state);
  return beside && coarseIsMissing({ reaction: beside }) ? `Beside it: ${missingWords(beside)}` : '';
}

function missingWords({ label }: Reaction): string {
  return label === null
    ? 'This take was made by another model, or kept without its layers.'
    : `The ${label} came ready-made, without its layers.`;
}
