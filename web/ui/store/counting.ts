/** How a song is counted: as dancers do, in groups of two bars, eight or six beats. */
import type { LoadedSong } from './reaction';
import { danceDuration } from './selectors';
import { songStart } from './song-shift';
import type { AppState, Counting, SongCounting } from './state';

type Parts = Pick<AppState, 'song' | 'leader' | 'shift' | 'countings'>;

/** Beats as they are counted. */
export interface CountedBeats {
  /** Seconds of the dance, ascending; the first ones may be before its start. */
  readonly times: readonly number[];
  readonly beatsPerBar: Counting['beatsPerBar'];
  /** Number of the first beat, from 0, that is a "1". */
  readonly first: number;
}

/** A beat's place; bar and count are from 1, and bars before the first "1" are 0 and below. */
export interface BarAndCount {
  readonly bar: number;
  readonly count: number;
}

/** The counting of a song: as it was found, or as the visitor has set it. */
export function countingOf(song: LoadedSong, countings: readonly SongCounting[]): Counting {
  const { beatsPerBar, beats, first } = song.data.rhythm;
  const found = { beatsPerBar, rate: 1, one: beats[first] ?? 0 } as const;
  return countings.find((counting) => isOf(counting, song)) ?? found;
}

/** Whether a counting was set for this song: the same file given again is the same song. */
export function isOf({ song, bytes }: SongCounting, { name, file }: LoadedSong): boolean {
  return song === name && bytes === file.size;
}

/** The beats that are counted, none without a song or a steady beat. */
export function countedBeats(state: Parts): CountedBeats {
  const { song } = state;
  if (!song) return { times: [], beatsPerBar: 4, first: 0 };
  const { beatsPerBar, rate, one } = countingOf(song, state.countings);
  const { beats } = song.data.rhythm;
  const start = songStart(state);
  const times = atRate(beats, rate, one);
  const first = times.length > 0 ? nearestIndex(times, one) % (2 * beatsPerBar) : 0;
  return { times: times.map((time) => time + start), beatsPerBar, first };
}

/** Every second beat, so that the "1" is among them; all; or all and the moments halfway between them. */
function atRate(beats: readonly number[], rate: Counting['rate'], one: number): readonly number[] {
  if (rate === 1) return beats;
  if (rate === 2)
    return beats.flatMap((beat, index) => {
      const next = beats[index + 1];
      return next === undefined ? [beat] : [beat, (beat + next) / 2];
    });
  const even = nearestIndex(beats, one) % 2;
  return beats.filter((_, index) => index % 2 === even);
}

/** Bar and count of a counted beat. */
export function placeOf({ beatsPerBar, first }: CountedBeats, index: number): BarAndCount {
  const beat = index - first;
  const group = 2 * beatsPerBar;
  return { bar: Math.floor(beat / beatsPerBar) + 1, count: (((beat % group) + group) % group) + 1 };
}

/** Whether a beat begins a count of eight or six, a bar, or neither. */
export type Accent = 'one' | 'bar' | 'beat';

export function accentOf(beats: CountedBeats, index: number): Accent {
  const { count } = placeOf(beats, index);
  return count === 1 ? 'one' : count === beats.beatsPerBar + 1 ? 'bar' : 'beat';
}

/** Assumed length of a beat where only one was found, seconds. */
const ONLY_BEAT_SECONDS = 0.5;

/** Bar and count at a time; null before the first beat, without beats, and once the last has lasted a beat. */
export function barAt(beats: CountedBeats, time: number): BarAndCount | null {
  const { times } = beats;
  const [last = 0, before = last - ONLY_BEAT_SECONDS] = [times.at(-1), times.at(-2)];
  if (time >= 2 * last - before) return null;
  const after = firstAfter(times, time + 1e-6);
  return after === 0 ? null : placeOf(beats, after - 1);
}

/** The beat nearest to a time, seconds of the dance; the time itself where the song has no beats around it. */
export function snapped({ times }: CountedBeats, time: number): number {
  if (times.length < 2) return time;
  const index = nearestIndex(times, time);
  const beat = times[index]!;
  const beside = times[index === 0 ? 1 : index - 1]!;
  return Math.abs(time - beat) <= Math.abs(beat - beside) * (0.5 + 1e-6) ? beat : time;
}

/** The next beat after a time, or the one before it; null where there is none. */
export function beatBeside({ times }: CountedBeats, time: number, direction: 1 | -1): number | null {
  if (direction > 0) return times[firstAfter(times, time + 1e-3)] ?? null;
  return times[firstAfter(times, time - 1e-3) - 1] ?? null;
}

/** Two moments nearer than this are the same one, seconds. */
const SAME_MOMENT = 0.01;

/** How far a bar is where no beats say it, seconds. */
const WITHOUT_BEATS = 1;

/**
 * The start of the next (1) or of the previous bar (-1), seconds; before the first and after the last one the start and
 * the end of the dance. Without beats it is a second away.
 */
export function barBeside(state: AppState, time: number, direction: 1 | -1): number {
  const beats = countedBeats(state);
  if (beats.times.length === 0) return time + direction * WITHOUT_BEATS;
  const starts = beats.times.filter((_, index) => accentOf(beats, index) !== 'beat');
  return direction > 0
    ? (starts.find((start) => start > time + SAME_MOMENT) ?? danceDuration(state))
    : (starts.findLast((start) => start < time - SAME_MOMENT) ?? 0);
}

/** Beats a minute as the song is counted: the tempo of the song, or half or double it. */
function countedTempo(song: LoadedSong, countings: readonly SongCounting[]): number {
  return song.data.rhythm.tempo * countingOf(song, countings).rate;
}

/** `144 BPM`, `100–135 BPM` where the tempo changes, `about 97 BPM` where it is not sure, or `no steady beat`. */
export function tempoText(song: LoadedSong, countings: readonly SongCounting[]): string {
  const { slowest, fastest, sure } = song.data.rhythm;
  const { rate } = countingOf(song, countings);
  const bpm = countedTempo(song, countings);
  if (bpm === 0) return 'no steady beat';
  if (!sure) return `about ${Math.round(bpm)} BPM`;
  if (fastest > CHANGING * slowest) return `${Math.round(slowest * rate)}–${Math.round(fastest * rate)} BPM`;
  return `${Math.round(bpm)} BPM`;
}

/** Ratio of the fastest to the slowest part from which a tempo changes: players waver by a few per cent. */
const CHANGING = 1.08;

/** Index of the value nearest to a time in an ascending list that is not empty. */
export function nearestIndex(times: readonly number[], time: number): number {
  const after = firstAfter(times, time);
  if (after === 0) return 0;
  if (after === times.length) return after - 1;
  return times[after]! - time < time - times[after - 1]! ? after : after - 1;
}

/** Index of the first value above a time, by binary search; the length where there is none. */
function firstAfter(times: readonly number[], time: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}
