import type { Manifest } from '../../../model/client';
import type { AppState, KeepingState, Take } from '../state';
import { manifestArrived } from './model';
import { type Change } from '../store';
import { NO_HISTORY, replacing } from '../history';
import { withTake } from '../take';

/** The browser keeps what is on the page, or has stopped to. */
export function keepingChanged(keeping: KeepingState): Change {
  return () => ({ keeping });
}

/** What an earlier visit left is there again. */
export function broughtBack(content: Partial<AppState>): Change {
  return () => ({ ...content, visiting: false, demo: 'ready', history: NO_HISTORY });
}

/** More takes of an earlier visit have come back. */
export function takesBroughtBack(more: readonly Take[]): Change {
  return ({ takes, takesMade, history }) => ({
    takes: more.reduce(
      (all, take) => (all.some(({ id }) => id === take.id) ? all : withTake(all, take)),
      takes,
    ),
    takesMade: Math.max(takesMade, ...more.map(({ number }) => number)),
    history,
  });
}

/** A project takes the place of everything; undoing brings back what was there. */
export function projectOpened(content: Partial<AppState>): Change {
  return (state) => replacing(state, { ...content, visiting: false });
}

/** Everything of the visitor's leaves the page, as if it were opened for the first time; undo brings it back. */
export function startedAfresh(manifest: Manifest | null, seed: number): Change {
  return (state) =>
    replacing(state, {
      ...(manifest && manifestArrived(manifest, seed)(state)),
      song: null,
      leader: null,
      reaction: null,
      takes: [],
      takesMade: 0,
      other: null,
      letter: 'A',
      compare: 'off',
      footLock: true,
      visiting: true,
      demo: 'loading',
      playback: { ...state.playback, playing: false, time: 0 },
    });
}
