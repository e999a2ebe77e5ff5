import { AppError } from '../../common/error';
import type { LeaderRequest } from '../../motion/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { sortStudyFiles } from './file-names';
import { OURS, type StudySet } from './set';

/**
 * Reads the dances of a study from files, which `sortStudyFiles` sorts. All are read before it begins, so that nothing
 * fails in the middle.
 *
 * @param onRead is told the share of the files that have been read
 * @throws {AppError} about the first file that can't be read, with its name
 */
export async function setOfFiles(
  files: readonly File[],
  read: (request: LeaderRequest) => Promise<{ readonly motion: SolvedMotion }>,
  onRead: (share: number) => void,
): Promise<StudySet> {
  const sorted = sortStudyFiles(files);
  const total = sorted.reduce((sum, { partners }) => sum + 1 + partners.size, 0);
  let done = 0;
  const motionOf = async (file: File): Promise<SolvedMotion> => {
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      const { motion } = await read({ files: [{ name: file.name, bytes }], options: {} });
      onRead(++done / total);
      return motion;
    } catch (error) {
      if (!(error instanceof AppError)) throw error;
      throw new AppError(error.code, `${file.name}: ${error.message}`, error.hint, { cause: error });
    }
  };
  const duets = [];
  for (const { name, leader, song, partners } of sorted) {
    const leaderMotion = await motionOf(leader);
    const motions = new Map<string, SolvedMotion>();
    for (const [method, file] of partners) motions.set(method, await motionOf(file));
    duets.push({
      name,
      methods: [...motions.keys()],
      song,
      leader: () => Promise.resolve(leaderMotion),
      partner: (method: string) => Promise.resolve(motions.get(method)!),
    });
  }
  const hasOurs = duets.some(({ methods }) => methods.includes(OURS));
  return { name: 'files', reference: hasOurs ? OURS : null, duets };
}
