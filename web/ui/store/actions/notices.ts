/** What is told to the visitor. */
import type { Problem } from '../state';
import type { Change } from '../store';

/** Keeps something worth knowing that stops nothing. */
export function noticeAdded(remark: string): Change {
  return ({ notices }) => (notices.includes(remark) ? {} : { notices: [...notices, remark] });
}

/** Tells for a moment what has just happened; null ends that. */
export function toastShown(toast: string | null): Change {
  return () => ({ toast });
}

/** Tells of a failure; while another one is being told, it waits its turn. */
export function problemShown(problem: Problem): Change {
  return (state) => {
    if (!state.problem) return { problem };
    const known = [state.problem, ...state.queuedProblems].some(
      ({ code, title }) => code === problem.code && title === problem.title,
    );
    return known ? {} : { queuedProblems: [...state.queuedProblems, problem] };
  };
}

/** Closes the failure in front; the next one, if any, is told. */
export function problemClosed(): Change {
  return ({ queuedProblems: [next, ...rest] }) => ({ problem: next ?? null, queuedProblems: rest });
}
