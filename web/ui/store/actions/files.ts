/** What happens to song and leader. */
import type { AppState, LoadedLeader, LoadedSong, Reading, InputKind } from '../state';
import type { Change } from '../store';

export function readingSet(side: InputKind, reading: Reading | null): Change {
  return (state) => ({ reading: { ...state.reading, [side]: reading } });
}

/** A song is there, unshifted: the reaction shown stays until the one that hears it is ready. */
export function songLoaded(song: LoadedSong): Change {
  return (state) => ({
    song,
    shift: 0,
    reading: { ...state.reading, song: null },
    // Without a leader the song alone is what plays: another one is another length.
    ...(!state.leader && { zoom: null, playback: { ...state.playback, region: null } }),
  });
}

/** A leader is there: what answered another leader makes no sense beside this one and leaves. */
export function leaderLoaded(leader: LoadedLeader): Change {
  return (state) => ({
    leader,
    shift: 0,
    zoom: null,
    reaction: null,
    preview: null,
    reading: { ...state.reading, leader: null },
    playback: { ...state.playback, time: 0, playing: false, region: null },
  });
}

export function firstVisitEnded(): Change {
  return (state) => (state.firstVisit ? { firstVisit: false } : {});
}

export function demoChanged(demo: AppState['demo']): Change {
  return () => ({ demo });
}
