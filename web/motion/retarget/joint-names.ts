/** Joints that are found by their names, which a family of programs has in common. */
import { CONVENTIONS, LIMB_JOINTS, type LimbJoint, type SkeletonConvention } from './conventions';
import type { SourceJoint } from './source';
import { type JointName, type Side, SIDES } from '../skeleton/skeleton';

/** The joints of the trunk, which nearly every convention places differently. */
export const TRUNK_JOINTS: readonly JointName[] = ['pelvis', 'spine1', 'spine2', 'spine3'];
export const LEG: readonly LimbJoint[] = ['hip', 'knee', 'ankle'];
export const ARM: readonly LimbJoint[] = ['shoulder', 'elbow', 'wrist'];

/** A joint of a limb by its name among the 22. */
export function jointOf(side: Side, limb: LimbJoint): JointName {
  return `${side}_${limb === 'toe' ? 'foot' : limb}`;
}

/** A name in the form that is compared; null where it lacks the convention's prefix. */
function normalisedName({ whole, own }: BareName, { prefix }: SkeletonConvention): string | null {
  if (prefix === undefined) return normalise(own);
  return prefix.test(whole) ? normalise(whole.replace(prefix, '')) : null;
}

function normalise(name: string): string {
  return name
    .normalize('NFKC')
    .replace(/^.*[:|]/, '')
    .replace(/^(DEF|ORG)-/, '')
    .toLowerCase()
    .replaceAll(/[^\p{L}\p{N}]/gu, '');
}

/** Least share of a file's joints that a prefix belongs to. */
const PREFIX_SHARE = 0.8;

/** Most characters of a shared beginning. */
const MAX_PREFIX = 120;
/** A number that a program puts after every name, as Sketchfab does: `LeftUpLeg_055`. */
const NUMBER = /_\d+$/;

/** A joint's name without a number that nearly all names end in. */
interface BareName {
  readonly whole: string;
  /** The name without the beginning that nearly all share, too. */
  readonly own: string;
}

/** The beginning that nearly all names share, up to the last separator in it: `Character1_`, `dancer:Character1_`. */
function sharedPrefix(names: readonly string[]): string {
  let shared = '';
  while (shared.length < MAX_PREFIX) {
    const counts = new Map<string, number>();
    for (const name of names) {
      const next = name.startsWith(shared) && /^.{2,40}?[_:.|-]/u.exec(name.slice(shared.length))?.[0];
      if (next) counts.set(next, (counts.get(next) ?? 0) + 1);
    }
    const next = [...counts].find(([, count]) => count >= PREFIX_SHARE * names.length)?.[0];
    if (next === undefined) break;
    shared += next;
  }
  return shared;
}

/** The names of all nodes but tips, without what a program wrote before and after nearly all of them. */
function bareNames(nodes: readonly SourceJoint[]): (BareName | null)[] {
  const names = nodes.filter(({ endSite }) => !endSite).map(({ name }) => name);
  const numbered = names.filter((name) => NUMBER.test(name)).length >= PREFIX_SHARE * names.length;
  const shared = sharedPrefix(names);
  return nodes.map(({ name, endSite }) => {
    if (endSite) return null;
    const whole = numbered ? name.replace(NUMBER, '') : name;
    return { whole, own: whole.startsWith(shared) ? whole.slice(shared.length) : whole };
  });
}

/** The node of every joint that a convention has a name for; no node stands for two joints. */
function findJoints(
  names: readonly (BareName | null)[],
  convention: SkeletonConvention,
  sides: readonly [string, string],
): Map<JointName, number> {
  const found = new Map<JointName, number>();
  const byName = new Map<string, number>();
  names.forEach((name, index) => {
    const word = name && normalisedName(name, convention);
    if (word !== null && !byName.has(word)) byName.set(word, index);
  });
  const take = (joint: JointName, words: readonly string[]): void => {
    for (const word of words) {
      const node = byName.get(word);
      if (node === undefined || [...found.values()].includes(node)) continue;
      found.set(joint, node);
      return;
    }
  };
  for (const limb of LIMB_JOINTS) {
    SIDES.forEach((side, i) => {
      take(
        jointOf(side, limb),
        convention.limbs[limb].map((word) => word.replace('*', sides[i]!)),
      );
    });
  }
  take('neck', convention.neck);
  take('head', convention.head);
  TRUNK_JOINTS.forEach((joint, i) => convention.trunk && take(joint, [convention.trunk[i]!]));
  return found;
}

/** Number of required joints that were found; 0 where the convention has a trunk of which a joint is missing. */
function score(convention: SkeletonConvention, found: ReadonlyMap<JointName, number>): number {
  if (convention.trunk !== undefined && !TRUNK_JOINTS.every((joint) => found.has(joint))) return 0;
  const limbs = [...LEG, ...ARM].flatMap((limb) => SIDES.map((side) => jointOf(side, limb)));
  return limbs.filter((joint) => found.has(joint)).length + (found.has('head') || found.has('neck') ? 1 : 0);
}

/** The convention whose names most joints have, and the joints that they are. */
export function bestConvention(nodes: readonly SourceJoint[]): {
  readonly convention: SkeletonConvention;
  readonly found: Map<JointName, number>;
} {
  const names = bareNames(nodes);
  const tried = CONVENTIONS.flatMap((convention) =>
    convention.sides.map((sides) => {
      const found = findJoints(names, convention, sides);
      return { convention, found, score: score(convention, found) };
    }),
  );
  return tried.reduce((best, one) => (one.score > best.score ? one : best));
}
