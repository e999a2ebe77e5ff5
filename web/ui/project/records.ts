import * as v from 'valibot';
import { counted } from '../store/format';
import { newestFirst } from '../store/take';
import { leader, MAX_FILES, motion, page, song, take } from './schema';
import type { StoredPage, StoredProject, StoredTake } from './stored-project';

/** Records as they lie in the database or in a project file: anything may be in them. */
export interface FoundProject {
  readonly songs: readonly unknown[];
  readonly leaders: readonly unknown[];
  readonly motions: readonly unknown[];
  readonly takes: readonly unknown[];
  readonly page: unknown;
}

/** The records that fit, and sentences about those that are left out. */
interface CheckedProject {
  readonly project: StoredProject;
  readonly losses: readonly string[];
}

/**
 * Checks every record by its shape and its meaning. A take needs its motion and its leader; songs and leaders that
 * nothing refers to are not read. A page whose leader is gone gets the newest take.
 */
export function checked(found: FoundProject): CheckedProject {
  const songs = fitting(song, found.songs);
  const leaders = fitting(leader, found.leaders);
  const motions = fitting(motion, found.motions);
  const takes = fitting(take, found.takes);
  const pageRead = v.safeParse(page, found.page);
  const now = pageRead.success ? pageRead.output : v.parse(page, {});

  const wholeTakes = [...takes.values()]
    .filter((one) => leaders.has(one.leader) && motions.has(one.motion))
    .map((one) => (one.song === null || songs.has(one.song) ? one : { ...one, song: null }))
    .toSorted(newestFirst);
  const there: StoredPage = {
    ...now,
    leader: now.leader !== null && leaders.has(now.leader) ? now.leader : null,
    song: now.song !== null && songs.has(now.song) ? now.song : null,
  };
  const shown = there.leader === null ? withTake(there, wholeTakes[0]) : there;
  const usedLeaders = firstUsed([shown.leader, ...wholeTakes.map((one) => one.leader)]);
  const keptTakes = wholeTakes.filter((one) => usedLeaders.has(one.leader));
  const usedSongs = firstUsed([shown.song, ...keptTakes.map((one) => one.song)]);
  const usedMotions = new Set(keptTakes.map((one) => one.motion));
  const project: StoredProject = {
    songs: [...songs.values()].filter((one) => usedSongs.has(one.id)),
    leaders: [...leaders.values()].filter((one) => usedLeaders.has(one.id)),
    motions: [...motions.values()].filter((one) => usedMotions.has(one.id)),
    takes: keptTakes,
    page: shown,
  };
  const lost = [
    [found.songs.length - songs.size, 'song'],
    [found.leaders.length - leaders.size, 'leader'],
    [found.motions.length - motions.size, 'motion'],
    [found.takes.length - keptTakes.length, 'take'],
  ] as const;
  const texts = lost.filter(([number]) => number > 0).map(([number, what]) => counted(number, what));
  const losses = texts.length > 0 ? [`What was damaged or incomplete is left out: ${texts.join(', ')}.`] : [];
  return { project, losses };
}

/** The records of one kind that fit, by their ids; of several with one id the first. */
function fitting<T extends { readonly id: string }>(
  schema: v.GenericSchema<unknown, T>,
  found: readonly unknown[],
): ReadonlyMap<string, T> {
  const byId = new Map<string, T>();
  for (const record of found) {
    const result = v.safeParse(schema, record);
    if (result.success && !byId.has(result.output.id)) byId.set(result.output.id, result.output);
  }
  return byId;
}

/** The page as it would be with this take chosen; without a take as it is. */
function withTake(page: StoredPage, take: StoredTake | undefined): StoredPage {
  if (!take) return page;
  const { id, leader, song, inputs } = take;
  return { ...page, leader, song, inputs, shown: id, other: null };
}

/** The first ids of which there are so many that they are read in a bearable time. */
function firstUsed(ids: readonly (string | null)[]): Set<string> {
  return new Set([...new Set(ids.filter((one) => one !== null))].slice(0, MAX_FILES));
}
