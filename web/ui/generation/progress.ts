import { generatedRole, roleName } from '../store/roles';
import { el, rememberFocus, setText, UNTRANSLATED } from '../widgets/dom';
import { createMeter } from '../widgets/meter';
import { jobText } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { AppState } from '../store/state';
import { watchAll } from '../store/store';

/** A job shorter than this shows no progress. */
const SHOW_AFTER_MS = 400;

/** The progress of the reaction that is being made, over the stage, with a button to cancel it. */
export const mountProgress: Mount = (root, store, services) => {
  const stageText = el('span', { class: 'soft' });
  const meter = createMeter('Generation');
  const cancel = createCancel(services);
  const title = el('b');
  const box = el('div', { class: 'float progress' }, el('span', {}, title, stageText), meter.element, cancel);
  box.hidden = true;
  // Announced at the start, half way and at the end, not at every step.
  const spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  root.append(box, spoken);

  let timer: ReturnType<typeof setTimeout> | null = null;
  /** The reactions that were there when the job began. */
  let before: readonly unknown[] = [];
  let giveBackFocus = rememberFocus();
  const end = (state: AppState): void => {
    if (timer === null) return;
    clearTimeout(timer);
    timer = null;
    const isMade = !box.hidden && state.reaction !== null && !before.includes(state.reaction);
    const giveBack = giveBackFocus;
    setText(spoken, isMade ? `The ${generatedRole(state)} is ready.` : '');
    // Not before the button that began the job is enabled again.
    queueMicrotask(() => {
      giveBack(box);
      box.hidden = true;
    });
  };
  const show = (state: AppState): void => {
    const { job } = state;
    if (!job) {
      end(state);
      return;
    }
    if (timer === null) {
      before = [
        state.reaction,
        ...[...state.takes, ...(state.variations?.list ?? [])].map((made) => made.reaction),
      ];
      giveBackFocus = rememberFocus();
    }
    timer ??= setTimeout(() => {
      box.hidden = false;
      setText(spoken, `The ${generatedRole(state)} is being made.`);
    }, SHOW_AFTER_MS);
    if (!box.hidden && job.fraction >= 0.5) setText(spoken, `The ${generatedRole(state)} is half made.`);
    setText(title, `${roleName(generatedRole(state))}: `);
    setText(stageText, jobText(job, state));
    meter.show(job.fraction);
  };
  watchAll(store, (state) => [state.job, state.model], show);
};

function createCancel(services: Services): HTMLElement {
  return el(
    'button',
    {
      class: 'btn tint',
      attributes: { type: 'button' },
      on: { click: services.cancel },
    },
    'Cancel ',
    el('kbd', { text: 'Esc', attributes: { 'aria-hidden': 'true', ...UNTRANSLATED } }),
  );
}
