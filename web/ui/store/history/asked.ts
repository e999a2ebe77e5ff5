/** Songs and leaders that are being read, as something that can be undone. */
import type { Files } from '../services';
import type { AppState, InputKind } from '../state';
import { apply, type Store } from '../store';
import { type Step, undone } from './history';

/** A song or leader that the visitor has asked for and that is still being read. */
export interface Asked {
  readonly kind: InputKind;
  /** The last step of undo before it; null where there was none. */
  readonly after: Step | null;
}

/** Makes the reading of a song or leader something that undo ends; returns what is called when it is over. */
export function ask(store: Store, kind: InputKind): () => void {
  const asked: Asked = { kind, after: store.getState().history.past.at(-1) ?? null };
  apply(store, (state) => ({ asked: [...state.asked.filter((one) => one.kind !== kind), asked] }));
  return () => {
    if (store.getState().asked.includes(asked))
      apply(store, (state) => ({ asked: state.asked.filter((one) => one !== asked) }));
  };
}

/** What undo ends the reading of; null where a step is newer than all that is being read. */
export function askedLast({ asked, history }: AppState): InputKind | null {
  const last = history.past.at(-1);
  const newest = asked.at(-1);
  return newest && (!last || newest.after === last) ? newest.kind : null;
}

/** Undoes what the visitor did last: a step, or the request for a song or leader that is still being read. */
export function undoLast(store: Store, files: Pick<Files, 'cancel'>): void {
  const kind = askedLast(store.getState());
  if (kind) files.cancel(kind);
  else apply(store, undone());
}
