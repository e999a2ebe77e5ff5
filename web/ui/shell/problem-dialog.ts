import { textButton } from '../widgets/button';
import { RATES } from '../files/import-report';
import { createDialogPlace } from '../widgets/dialog-place';
import { el } from '../widgets/dom';
import type { Mount, Services } from '../store/services';
import type { LeaderSource } from '../store/reaction';
import type { AppState, Problem } from '../store/state';
import { apply, watch, type Store } from '../store/store';
import { problemClosed, problemDismissed } from '../store/actions/notices';
import { panelToggled } from '../store/actions/view';

/** A failure over the stage: what is wrong and what to do. Everything loaded before stays loaded. */
export const mountProblemDialog: Mount = (root, store, services) => {
  const place = createDialogPlace(root);
  watch(
    store,
    (state) => state.problem,
    (problem) => {
      root.classList.toggle('dimmed', problem !== null);
      place.close();
      // First the focus leaves the Cancel button of a job that has failed, so that it does not go back there.
      queueMicrotask(() => {
        const state = store.getState();
        if (problem && state.problem === problem)
          place.show(build(problem, state, store, services), 'button');
      });
    },
  );
};

function build(problem: Problem, state: AppState, store: Store, services: Services): HTMLElement {
  const action = (text: string, kind: string, run: () => void, close = problemClosed): HTMLElement =>
    textButton(`btn ${kind}`, text, () => {
      apply(store, close());
      run();
    });
  const remedy = remedyOf(problem, services);
  return el(
    'section',
    {
      class: 'float problem',
      attributes: {
        role: 'alertdialog',
        'aria-labelledby': 'problem-title',
        'aria-describedby': 'problem-hint',
        'data-code': problem.code,
      },
    },
    el('h1', { attributes: { id: 'problem-title' } }, ...unbroken(problem.title)),
    el('p', { text: hintOf(problem, state), attributes: { id: 'problem-hint' } }),
    problem.code === 'bad-frame-time' && state.refusedLeader
      ? rateRow(state.refusedLeader, store, services)
      : null,
    el(
      'div',
      { class: 'actions' },
      remedy && action(remedy.text, 'primary', remedy.run),
      losesWork(problem, state) ? action('Save project', 'tint', services.saveProject) : null,
      problem.remedy === 'leader' && state.refusedLeader
        ? action('Joints and units', 'ghost', () => {
            apply(store, panelToggled('import'));
          })
        : null,
      action(dismissLabel(problem, state), remedy ? 'ghost' : 'primary', () => undefined, problemDismissed),
    ),
  );
}

/** Whether the remedy takes away what the browser does not keep. */
const losesWork = ({ remedy }: Problem, { autosave }: Pick<AppState, 'autosave'>): boolean =>
  remedy === 'reload' && autosave !== 'stored';

/** The hint; before a reload also what becomes of the visitor's work. */
export function hintOf(problem: Problem, state: Pick<AppState, 'autosave'>): string {
  if (problem.remedy !== 'reload') return problem.hint;
  const kept = losesWork(problem, state)
    ? 'Save your project first: this browser does not keep it.'
    : 'Song, leader, takes and settings stay.';
  return `${problem.hint} ${kept}`;
}

/** The frame rate by hand; choosing one reads the file again. */
function rateRow(source: LeaderSource, store: Store, services: Services): HTMLElement {
  const select = el(
    'select',
    {
      on: {
        change: () => {
          apply(store, problemClosed());
          services.rereadLeader(source, { ...source.options, fps: Number(select.value) });
        },
      },
    },
    el('option', { text: 'choose a frame rate', attributes: { value: '', disabled: '', selected: '' } }),
    ...RATES.map((fps) => el('option', { text: `${fps} frames per second`, attributes: { value: fps } })),
  );
  return el('label', { class: 'rate' }, 'Read it again at ', select);
}

/** A sentence whose short quotations stay on one line. */
function unbroken(sentence: string): (Node | string)[] {
  return sentence
    .split(/("[^"]{0,24}")/)
    .map((part, index) => (index % 2 === 1 ? el('span', { class: 'quoted', text: part }) : part));
}

function remedyOf(problem: Problem, services: Services): { text: string; run: () => void } | null {
  switch (problem.remedy) {
    case 'song':
    case 'leader':
    case 'any-file': {
      const side = problem.remedy === 'any-file' ? 'any' : problem.remedy;
      return {
        text: 'Choose another file',
        run: () => {
          services.choose(side);
        },
      };
    }
    case 'read-again': {
      const kind = problem.refused?.kind;
      return kind ? { text: 'Try again', run: () => services.readAgain(kind) } : null;
    }
    case 'model':
      return { text: 'Try again', run: services.retryModel };
    case 'own-model':
      return { text: 'Try again', run: services.reopenModel };
    case 'generate':
      return { text: 'Try again', run: services.generate };
    case 'project':
      return { text: 'Save project', run: services.saveProject };
    case 'reload':
      return { text: 'Reload', run: services.reload };
    case 'none':
      return null;
  }
}

/** The label of the button that closes the dialog. It names the files that stay: `Keep leader_0412.bvh`, or song and leader where the file could have been either. */
export function dismissLabel(problem: Problem, { song, leader }: Pick<AppState, 'song' | 'leader'>): string {
  if (!problem.refused) return 'Close';
  const { kind } = problem.refused;
  const kept = kind ? [{ song, leader }[kind]] : [song, leader];
  const names = kept.flatMap((file) => (file ? [file.name] : []));
  return names.length > 0 ? `Keep ${names.join(' and ')}` : 'Close';
}
