import { besideStage, coarseIsMissing } from '../generation/coarse-layer';
import { el, setAttribute, setText, together } from '../widgets/dom';
import type { Mount } from '../store/services';
import { SHOWS } from '../store/overlays';
import type { AppState, Reaction } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { mountTakesButton } from '../takes/takes-panel';
import { opened, shownToggled } from '../store/actions/view';

/** The button on the stage and its menu: what is drawn beside the dancers. */
export const mountShowMenu: Mount = (root, store, services) => {
  const count = el('span', { class: 'count-on' });
  const button = el(
    'button',
    {
      class: 'btn',
      attributes: { type: 'button', 'aria-haspopup': 'dialog' },
      on: {
        click: () => {
          apply(store, opened('show'));
        },
      },
    },
    'Show',
    count,
  );
  const toggles = SHOWS.map(({ what, label, key, hint }) =>
    el(
      'button',
      {
        class: 'it',
        attributes: { type: 'button', title: hint, 'aria-keyshortcuts': key, 'aria-label': label },
        on: {
          click: () => {
            apply(store, shownToggled(what));
          },
        },
      },
      el('span', { class: 'led', attributes: { 'aria-hidden': true } }),
      el('span', { class: 'name', text: label }),
      el('kbd', { class: 'desk', text: key, attributes: { 'aria-hidden': true } }),
    ),
  );
  const make = el('button', {
    class: 'btn',
    text: 'Generate it here',
    attributes: { type: 'button' },
    on: {
      click: () => {
        services.generate();
      },
    },
  });
  const words = el('span');
  const note = el('div', { class: 'note' }, words, make);
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
  root.append(corner);
  const takes = mountTakesButton(corner, store, services);

  const showState = (state: AppState): void => {
    const { shown, coarse, job } = state;
    SHOWS.forEach(({ what }, i) => {
      setAttribute(toggles[i]!, 'aria-pressed', String(shown[what]));
    });
    const on = SHOWS.filter(({ what }) => shown[what]).length;
    setText(count, on > 0 ? String(on) : '');
    button.setAttribute('aria-label', on > 0 ? `Show, ${on} on` : 'Show');
    const missing = coarseIsMissing(state);
    note.hidden = noteWords(state) === '';
    make.hidden = !missing || job !== null;
    setText(words, noteWords(state));
    setAttribute(ghost!, 'aria-busy', coarse.decoding ? 'true' : undefined);
  };
  const showOpen = (open: boolean): void => {
    const was = !menu.hidden;
    menu.hidden = !open;
    button.setAttribute('aria-expanded', String(open));
    if (open) ghost?.focus();
    else if (was && menu.contains(document.activeElement)) button.focus();
  };
  const closeOutside = (event: PointerEvent): void => {
    if (!menu.hidden && !corner.contains(event.target as Node)) apply(store, opened('show'));
  };
  document.addEventListener('pointerdown', closeOutside);
  return together(
    watchAll(
      store,
      (state) => [state.shown, state.coarse, state.reaction, besideStage(state), state.job === null],
      showState,
    ),
    watch(store, (state) => state.open === 'show', showOpen),
    takes,
    () => {
      document.removeEventListener('pointerdown', closeOutside);
      corner.remove();
    },
  );
};

/** What there is to say about the coarse ghost while it can't be seen; nothing when it can. */
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
