import type { AxisName, UnitName } from './axes-and-units';
import type { JointName } from '../skeleton/skeleton';

/** The joint of a file for some of the 22 joints, by name; null for one that is to be estimated. */
export type JointChoice = Readonly<Partial<Record<JointName, string | null>>>;

/** What is set by hand about a motion file, in place of what is found in it. Plain data: it is stored with the leader. */
export interface ImportOptions {
  /** Frames per second. */
  readonly fps?: number | undefined;
  readonly unit?: UnitName | undefined;
  readonly up?: AxisName | undefined;
  /** Turn of the whole dance about the vertical, degrees, seen from above against the clock. */
  readonly turn?: number | undefined;
  /** Height of the floor in the file, metres after unit and up axis; the lowest standing feet where it is not set. */
  readonly floor?: number | undefined;
  /** Number of the clip or dancer in a file with several. */
  readonly part?: number | undefined;
  readonly joints?: JointChoice | undefined;
}

/** Joints chosen in earlier files, by the fingerprint of their skeleton. */
export type RememberedJoints = Readonly<Record<string, JointChoice>>;

/** Identifies a skeleton by the names of its joints (FNV-1a over them in order). */
export function skeletonFingerprint(names: readonly string[]): string {
  let hash = 0x811c9dc5;
  for (const character of names.join('\n')) {
    hash = Math.imul(hash ^ character.codePointAt(0)!, 0x01000193) >>> 0;
  }
  return `${names.length}-${hash.toString(16).padStart(8, '0')}`;
}
