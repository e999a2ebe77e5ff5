/** How the song is counted. */
import { countedBeats, countingOf, isOf, nearestIndex } from '../counting';
import { songStart } from '../song-shift';
import type { AppState, Counting } from '../state';
import type { Change } from '../store';

/** Songs whose counting is remembered. */
const MAX_COUNTINGS = 100;

/** Changes how the song on the page is counted; null counts it as it was found again. */
export function countingSet(change: Partial<Counting> | null): Change {
  return ({ song, countings }) => {
    if (!song || song.data.rhythm.beats.length === 0) return {};
    const others = countings.filter((counting) => !isOf(counting, song));
    if (!change) return others.length === countings.length ? {} : { countings: others };
    const before = countingOf(song, countings);
    const after = { ...before, ...change };
    const same = (Object.keys(after) as (keyof Counting)[]).every((key) => after[key] === before[key]);
    const own = { ...after, song: song.name, bytes: song.file.size };
    return same ? {} : { countings: [own, ...others].slice(0, MAX_COUNTINGS) };
  };
}

/** How songs were counted in an earlier visit; what the visitor has set meanwhile counts. */
export function countingsRestored(earlier: AppState['countings']): Change {
  return ({ countings, history }) => ({
    countings: [...countings, ...earlier].slice(0, MAX_COUNTINGS),
    history,
  });
}

/** Makes the counted beat nearest to a time (seconds of the dance) a "1". */
export function oneSet(time: number): Change {
  return (state) => {
    const { times } = countedBeats(state);
    if (times.length === 0) return { settingOne: false };
    const one = times[nearestIndex(times, time)]! - songStart(state);
    return { ...countingSet({ one })(state), settingOne: false };
  };
}

/** Whether the next click on ruler or song sets the "1". */
export function settingOneSet(settingOne: boolean): Change {
  return () => ({ settingOne });
}
