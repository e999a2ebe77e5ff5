import type { JointChoice, RememberedJoints } from '../../../motion/retarget/options';

const KEY = 'reactdance-joints';
/** Skeletons whose choices are kept; the oldest are forgotten. */
const MOST = 50;

/** The part of localStorage that is needed. */
type Store = Pick<Storage, 'getItem' | 'setItem'>;

/** Joints that the visitor has chosen, by skeleton, between visits. Without storage nothing is remembered. */
export class RememberedJointsStorage {
  constructor(private readonly storage: () => Store) {}

  read(): RememberedJoints {
    try {
      const stored: unknown = JSON.parse(this.storage().getItem(KEY) ?? '{}');
      const isRecord = stored !== null && typeof stored === 'object' && !Array.isArray(stored);
      return isRecord ? (stored as RememberedJoints) : {};
    } catch {
      return {};
    }
  }

  /** @param choice null forgets what was chosen for this skeleton */
  remember(skeleton: string, choice: JointChoice | null): void {
    const others = Object.entries(this.read()).filter(([key]) => key !== skeleton);
    const all = choice ? [...others, [skeleton, choice] as const] : others;
    try {
      this.storage().setItem(KEY, JSON.stringify(Object.fromEntries(all.slice(-MOST))));
    } catch {
      // A full or forbidden storage: the choice holds for this visit only.
    }
  }
}
