/** Problems, notices and toasts. */
import type { Problem } from '../state';
import type { Change } from '../store';

/** Adds a sentence to know about that stops nothing. */
export function noticeAdded(notice: string): Change {
  return ({ notices }) => (notices.includes(notice) ? {} : { notices: [...notices, notice] });
}

/** Shows for a few seconds what has just happened; null ends that. */
export function toastShown(text: string | null): Change {
  return () => ({ toast: text === null ? null : { text } });
}

/** Shows a failure; while another one is shown, it is queued. */
export function problemShown(problem: Problem): Change {
  return (state) => {
    if (!state.problem) return { problem };
    const known = [state.problem, ...state.queuedProblems].some(
      ({ code, title }) => code === problem.code && title === problem.title,
    );
    return known ? {} : { queuedProblems: [...state.queuedProblems, problem] };
  };
}

/** Closes the failure that is shown; the next one in the queue, if any, is shown. */
export function problemClosed(): Change {
  return ({ queuedProblems: [next, ...rest] }) => ({ problem: next ?? null, queuedProblems: rest });
}

/** Closes the failure without its remedy: a leader that was refused is forgotten where another one stays. */
export function problemDismissed(): Change {
  return (state) => ({
    ...problemClosed()(state),
    ...(state.leader && state.problem?.refused?.kind === 'leader' && { refusedLeader: null }),
  });
}
