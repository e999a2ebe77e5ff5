/** Song and leader. */
import type { LeaderSource, LoadedLeader, LoadedSong } from '../reaction';
import type { AppState, GivenFiles, InputKind, PartRead, Reading } from '../state';
import type { Change } from '../store';

export function readingSet(side: InputKind, reading: Reading | null): Change {
  return (state) => ({ reading: { ...state.reading, [side]: reading } });
}

/** Puts a song on the page, unshifted: the present reaction stays until the one to this song is ready. */
export function songLoaded(song: LoadedSong): Change {
  return (state) => ({
    song,
    shift: 0,
    reading: { ...state.reading, song: null },
    // Without a leader the song sets the length of what plays.
    ...(!state.leader && {
      zoom: null,
      playback: { ...state.playback, time: Math.min(state.playback.time, song.data.duration), region: null },
    }),
  });
}

/** Puts a leader on the page: the reaction to another leader is removed from the stage. */
export function leaderLoaded(leader: LoadedLeader): Change {
  return (state) => ({
    leader,
    shift: 0,
    zoom: null,
    reaction: null,
    preview: null,
    refusedLeader: null,
    reading: { ...state.reading, leader: null },
    playback: { ...state.playback, time: 0, playing: false, region: null },
  });
}

/** Shows the first seconds of a video on the stage while the rest is being read; null ends that. */
export function partReadSet(partRead: PartRead | null): Change {
  return () => ({ partRead });
}

/** Keeps a leader that could not be read, so that it can be read again in another way; null forgets it. */
export function leaderRefused(refusedLeader: LeaderSource | null): Change {
  return () => ({ refusedLeader });
}

/** Shows files that were given together as a list to choose from; null closes it. */
export function givenSet(given: GivenFiles | null): Change {
  return () => ({ given });
}

export function firstVisitEnded(): Change {
  return (state) => (state.firstVisit ? { firstVisit: false } : {});
}

export function demoChanged(demo: AppState['demo']): Change {
  return () => ({ demo });
}
