import type { Manifest } from '../../../model/client';
import type { LoadedSong, Take } from '../reaction';
import type { AppState, AutosaveStatus, Restoring } from '../state';
import { manifestLoaded } from './model';
import { type Change } from '../store';
import { NO_HISTORY, withUndoOfAll, withUndoOfClearing } from '../history/history';
import { mergedTakes, withOwnNumbers, withTake } from '../take';

/** Whether autosave works has changed. */
export function autosaveChanged(autosave: AutosaveStatus): Change {
  return () => ({ autosave });
}

/** The browser has answered whether it keeps what is stored when space is short. */
export function persistenceAnswered(persistent: boolean | null): Change {
  return () => ({ persistent });
}

/** Says what is being restored; null when all of it is there. */
export function restoringSet(restoring: Restoring | null): Change {
  return (state) => (restoring || state.restoring ? { restoring } : {});
}

/** An earlier visit stored nothing: it begins as a first one, unless the visitor has chosen a file meanwhile. */
export function nothingRestored(): Change {
  return ({ leader, song, reading }) =>
    leader || song || reading.leader || reading.song ? {} : { firstVisit: true };
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

/** The song of restored takes has been read, which are there without it; it is the page's too, unless it has another. */
export function songRestored(song: LoadedSong, ids: ReadonlySet<string>): Change {
  return (state) => {
    const { history, reaction } = state;
    const isTheirs = ({ id, reaction: made }: Take): boolean => ids.has(id) && made.inputs.song === null;
    const takes = state.takes.map((take) => {
      const { inputs } = take.reaction;
      return isTheirs(take) ? { ...take, reaction: { ...take.reaction, inputs: { ...inputs, song } } } : take;
    });
    const shown = state.takes.findIndex((take) => take.reaction === reaction);
    const belongs = shown < 0 || takes[shown] !== state.takes[shown];
    return {
      takes,
      reaction: takes[shown]?.reaction ?? reaction,
      song: state.song ?? (belongs ? song : null),
      history,
    };
  };
}

/**
 * Takes that another tab has stored are on this page too (see `mergedTakes`); what is on the stage stays.
 * @param synced see `mergedTakes`
 */
export function takesMerged(stored: readonly Take[], synced: readonly Take[]): Change {
  return (state) => {
    const takes = withOwnNumbers(mergedTakes(state.takes, synced, stored));
    const shown = state.takes.find(({ reaction }) => reaction === state.reaction);
    const reaction = takes.find(({ id }) => id === shown?.id)?.reaction ?? state.reaction;
    return {
      takes,
      reaction,
      // A take that the other tab made anew, by the same drag for example, has other settings.
      ...(reaction !== state.reaction && reaction?.inputs),
      takesMade: Math.max(state.takesMade, ...takes.map(({ number }) => number)),
      history: state.history,
    };
  };
}

/** A project replaces everything on the page; undo brings back what was there. */
export function projectOpened(content: Partial<AppState>): Change {
  return (state) => ({
    ...withUndoOfAll(state, { ...content, notices: [], zoom: null, firstVisit: false }),
    preview: null,
  });
}

/**
 * The page is emptied, as if it were opened for the first time; undo brings everything back until the visitor makes a take.
 */
export function projectCleared(manifest: Manifest | null, seed: number): Change {
  return (state) =>
    withUndoOfClearing(state, {
      ...(manifest && manifestLoaded(manifest, seed)(state)),
      song: null,
      leader: null,
      shift: 0,
      reaction: null,
      takes: [],
      takesMade: 0,
      other: null,
      letter: 'A',
      compare: 'off',
      countings: [],
      notices: [],
      footLock: true,
      firstVisit: true,
      demo: 'loading',
      playback: { ...state.playback, playing: false, time: 0, region: null },
      zoom: null,
    });
}
