import type { Manifest } from '../../../model/client';
import type { Take } from '../reaction';
import type { AppState, AutosaveStatus } from '../state';
import { manifestLoaded } from './model';
import { type Change } from '../store';
import { NO_HISTORY, withUndoOfAll } from '../history';
import { withTake } from '../take';

/** Whether autosave works has changed. */
export function autosaveChanged(autosave: AutosaveStatus): Change {
  return () => ({ autosave });
}

/** What an earlier visit stored is on the page again. */
export function visitRestored(content: Partial<AppState>): Change {
  return () => ({ ...content, firstVisit: false, demo: 'ready', history: NO_HISTORY });
}

/** More takes of an earlier visit have been restored. */
export function takesRestored(more: readonly Take[]): Change {
  return ({ takes, takesMade, history }) => ({
    takes: more.reduce(
      (all, take) => (all.some(({ id }) => id === take.id) ? all : withTake(all, take)),
      takes,
    ),
    takesMade: Math.max(takesMade, ...more.map(({ number }) => number)),
    history,
  });
}

/** A project replaces everything on the page; undo brings back what was there. */
export function projectOpened(content: Partial<AppState>): Change {
  return (state) => withUndoOfAll(state, { ...content, firstVisit: false });
}

/** The page is emptied, as if it were opened for the first time; undo brings everything back. */
export function projectCleared(manifest: Manifest | null, seed: number): Change {
  return (state) =>
    withUndoOfAll(state, {
      ...(manifest && manifestLoaded(manifest, seed)(state)),
      song: null,
      leader: null,
      reaction: null,
      takes: [],
      takesMade: 0,
      other: null,
      letter: 'A',
      compare: 'off',
      countings: [],
      footLock: true,
      firstVisit: true,
      demo: 'loading',
      playback: { ...state.playback, playing: false, time: 0 },
    });
}
