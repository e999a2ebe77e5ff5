/** What is told to the visitor. */
import type { Problem } from '../state';
import type { Change } from '../store';

/** Keeps something worth knowing that stops nothing. */
export function remarked(remark: string): Change {
  return ({ remarks }) => (remarks.includes(remark) ? {} : { remarks: [...remarks, remark] });
}

/** Tells for a moment what has just happened; null ends that. */
export function announced(news: string | null): Change {
  return () => ({ news });
}

/** Tells of a failure; while another one is being told, it waits its turn. */
export function told(problem: Problem): Change {
  return (state) => {
    if (!state.problem) return { problem };
    const known = [state.problem, ...state.waitingProblems].some(
      ({ code, title }) => code === problem.code && title === problem.title,
    );
    return known ? {} : { waitingProblems: [...state.waitingProblems, problem] };
  };
}

/** Closes the failure in front; the next one, if any, is told. */
export function dismissed(): Change {
  return ({ waitingProblems: [next, ...rest] }) => ({ problem: next ?? null, waitingProblems: rest });
}
