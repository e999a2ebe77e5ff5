import type { SourceJoint } from '../../../motion/retarget/source';
import type { JointChoice } from '../../../motion/retarget/options';
import { type JointName, otherSide, SMPL22 } from '../../../motion/skeleton/skeleton';

/** For each of the 22 the index of the file's joint that stands for it; null where it is to be estimated. */
export type ChosenJoints = Readonly<Record<JointName, number | null>>;

/** The same with the joints of both sides exchanged. */
export function sidesExchanged(chosen: ChosenJoints): ChosenJoints {
  return Object.fromEntries(SMPL22.map((name) => [name, chosen[otherSide(name)]])) as unknown as ChosenJoints;
}

/** All 22 by the names of the file's joints; null where nothing differs from what was found. */
export function changedChoice(
  found: ChosenJoints,
  chosen: ChosenJoints,
  joints: readonly Pick<SourceJoint, 'name'>[],
): JointChoice | null {
  if (SMPL22.every((name) => found[name] === chosen[name])) return null;
  const nameOf = (index: number | null): string | null => (index === null ? null : joints[index]!.name);
  return Object.fromEntries(SMPL22.map((name) => [name, nameOf(chosen[name])]));
}
