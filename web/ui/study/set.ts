import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Comparable } from './plan';

/** A leader's dance with its partners, which are read or generated when they are shown. */
export interface StudyDuet extends Comparable {
  readonly song: Blob | null;
  readonly leader: () => Promise<SolvedMotion>;
  /** @throws {AppError} when it can't be made */
  readonly partner: (method: string) => Promise<SolvedMotion>;
}

/** The dances of a study. */
export interface StudySet {
  readonly name: string;
  /** The method that the others are compared with; null compares all with each other. */
  readonly reference: string | null;
  readonly duets: readonly StudyDuet[];
}

/** The method that others are compared with where a set has it. */
export const OURS = 'ours';

/** All duets with their methods in order: two sets with the same content can go on with one another's answers. */
export function contentOf({ duets }: Pick<StudySet, 'duets'>): string {
  return duets
    .map(({ name, methods }) => `${name}: ${[...methods].sort().join(', ')}`)
    .sort()
    .join('; ');
}
