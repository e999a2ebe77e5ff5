import { AppError } from '../../common/error';

/** The files of one duet: its leader, a song if there is one, and a partner of each method. */
export interface DuetFiles<T> {
  readonly name: string;
  readonly leader: T;
  readonly song: T | null;
  readonly partners: ReadonlyMap<string, T>;
}

const SONG = /\.(mp3|wav|ogg|oga|opus|flac|m4a|aac)$/i;
/** The method that names the leader's own motion. */
const LEADER = 'leader';

/** DUET_METHOD.ending: what is after the last underscore is the method. */
const NAME = /^(.+)_([^_]+)\.\w+$/;

function refused(what: string): AppError {
  return new AppError(
    'not-a-study',
    what,
    'Name the files DUET_leader.bvh, DUET_METHOD.bvh for at least two methods, and DUET.mp3 for the music.',
  );
}

/**
 * Sorts the files of a study by their names: `salsa_leader.bvh`, `salsa_ours.bvh`, `salsa_truth.bvh`, `salsa.mp3`.
 *
 * @throws {AppError} `not-a-study`: a sentence about the first duet that can't be compared
 */
export function sortStudyFiles<T extends { readonly name: string }>(files: readonly T[]): DuetFiles<T>[] {
  const songs = new Map<string, T>();
  const duets = new Map<string, Map<string, T>>();
  for (const file of files) {
    if (SONG.test(file.name)) {
      songs.set(file.name.replace(SONG, ''), file);
      continue;
    }
    const [, duet, method] = NAME.exec(file.name) ?? [];
    if (duet === undefined || method === undefined)
      throw refused(`${file.name} does not say which duet and which method it is.`);
    const methods = duets.get(duet) ?? new Map<string, T>();
    if (methods.has(method)) throw refused(`${duet} has two files of “${method}”.`);
    duets.set(duet, methods.set(method, file));
  }
  if (duets.size === 0) throw refused('There is no dance among these files.');
  return [...duets].map(([name, methods]) => {
    const leader = methods.get(LEADER);
    if (!leader) throw refused(`${name} has no leader: ${name}_leader.bvh is missing.`);
    const partners = new Map([...methods].filter(([method]) => method !== LEADER));
    if (partners.size < 2)
      throw refused(
        `${name} has ${partners.size === 0 ? 'no partner' : 'one partner only'}: two are compared.`,
      );
    return { name, leader, song: songs.get(name) ?? null, partners };
  });
}
