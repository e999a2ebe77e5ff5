import type { BvhNode } from './hierarchy';
import {
  BVH_NAMES,
  CONVENTIONS,
  isOwnSkeleton,
  LIMB_JOINTS,
  type LimbJoint,
  OWN_CONVENTION,
  type SkeletonConvention,
} from './conventions';
import { AppError } from '../../common/error';
import { type JointName, SMPL22 } from '../skeleton/skeleton';

/** The node of a file for each joint. */
export interface JointMap {
  /** Name of the skeleton convention. */
  readonly convention: string;
  /** Node of every joint that the file has; the others are estimated. */
  readonly nodes: ReadonlyMap<JointName, number>;
  /** Whether the file has exactly the trunk of the SMPL skeleton, so that pelvis and spine are not estimated. */
  readonly hasSmplTrunk: boolean;
  /** Nodes of the spine between the hips and the neck, upwards. */
  readonly spine: readonly number[];
}

/** Name in the SMPL skeleton of a limb's joint. */
const SMPL_NAMES: Readonly<Record<LimbJoint, string>> = {
  hip: 'hip',
  knee: 'knee',
  ankle: 'ankle',
  toe: 'foot',
  shoulder: 'shoulder',
  elbow: 'elbow',
  wrist: 'wrist',
  collar: 'collar',
};
/** The joints of the trunk, which nearly every convention places differently. */
export const TRUNK_JOINTS: readonly JointName[] = ['pelvis', 'spine1', 'spine2', 'spine3'];
const LEG: readonly LimbJoint[] = ['hip', 'knee', 'ankle'];
const ARM: readonly LimbJoint[] = ['shoulder', 'elbow', 'wrist'];
const REQUIRED = new Set<LimbJoint>([...LEG, ...ARM]);

/** A node's name in the form that is compared; null where it lacks the convention's prefix. */
function normalisedName(name: string, convention: SkeletonConvention): string | null {
  if (convention.prefix !== undefined) {
    return convention.prefix.test(name) ? normalise(name.replace(convention.prefix, '')) : null;
  }
  return normalise(name);
}

function normalise(name: string): string {
  return name
    .replace(/^.*[:|]/, '')
    .replace(/^DEF-/, '')
    .toLowerCase()
    .replaceAll(/[^a-z0-9]/g, '');
}

/** The node of every joint that a convention has a name for; no node stands for two joints. */
function findJoints(
  nodes: readonly BvhNode[],
  convention: SkeletonConvention,
  sides: readonly [string, string],
): Map<JointName, number> {
  const found = new Map<JointName, number>();
  const byName = new Map<string, number>();
  nodes.forEach((node, index) => {
    const word = node.endSite ? null : normalisedName(node.name, convention);
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
    (['left', 'right'] as const).forEach((side, i) => {
      take(
        `${side}_${SMPL_NAMES[limb]}` as JointName,
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
  const limbs = [...REQUIRED].flatMap(
    (limb) => [`left_${SMPL_NAMES[limb]}`, `right_${SMPL_NAMES[limb]}`] as JointName[],
  );
  return limbs.filter((joint) => found.has(joint)).length + (found.has('head') || found.has('neck') ? 1 : 0);
}

function ancestors(nodes: readonly BvhNode[], node: number): number[] {
  const chain: number[] = [];
  for (let at = nodes[node]!.parent; at >= 0; at = nodes[at]!.parent) chain.push(at);
  return chain;
}

/** The error that names the missing joints, whole limbs before single joints; null when none is missing. */
function missingJoints(nodes: readonly BvhNode[], found: ReadonlyMap<JointName, number>): AppError | null {
  const missingOf = (limb: readonly LimbJoint[]): string[] =>
    ['left', 'right'].flatMap((side) =>
      limb
        .filter((joint) => !found.has(`${side}_${SMPL_NAMES[joint]}` as JointName))
        .map((joint) => `${side} ${joint}`),
    );
  const [legs, arms] = [missingOf(LEG), missingOf(ARM)];
  const top = found.has('head') || found.has('neck') ? [] : ['neck or head'];
  const missing = [...legs, ...arms, ...top];
  if (missing.length === 0) return null;
  const limbs = [legs.length === 6 ? 'legs' : '', arms.length === 6 ? 'arms' : ''].filter(
    (limb) => limb !== '',
  );
  const whole =
    limbs.length > 0
      ? `The body in this file has no ${limbs.join(' and no ')}`
      : 'The body in this file is incomplete';
  const names = nodes.filter(({ endSite }) => !endSite).map(({ name }) => name);
  const seen = names.slice(0, 8).join(', ') + (names.length > 8 ? ` and ${names.length - 8} more` : '');
  return new AppError(
    'missing-joints',
    `${whole}: no joint was found for ${missing.join(', ')}.`,
    `Its joints are called ${seen}. Use a whole body with the names of Mixamo, Character Creator, DAZ or MotionBuilder.`,
  );
}

/**
 * Finds the 22 joints among the nodes of a file, by the names of the convention of which most joints are found.
 *
 * @throws {AppError} `missing-joints` when a limb's joint or both neck and head cannot be found
 */
export function mapJoints(nodes: readonly BvhNode[]): JointMap {
  const names = nodes.filter(({ endSite }) => !endSite).map(({ name }) => name);
  if (isOwnSkeleton(names)) {
    const own = new Map(
      SMPL22.map((joint) => [
        joint,
        nodes.findIndex(({ name, endSite }) => !endSite && name === BVH_NAMES[joint]),
      ]),
    );
    return { convention: OWN_CONVENTION, nodes: own, hasSmplTrunk: true, spine: [] };
  }
  let best: { convention: SkeletonConvention; found: Map<JointName, number> } | null = null;
  for (const convention of CONVENTIONS) {
    for (const sides of convention.sides) {
      const found = findJoints(nodes, convention, sides);
      if (best === null || score(convention, found) > score(best.convention, best.found))
        best = { convention, found };
    }
  }
  const { convention, found } = best!;
  const error = missingJoints(nodes, found);
  if (error) throw error;

  const top = found.get('neck') ?? found.get('head')!;
  const below = new Set([
    ...ancestors(nodes, found.get('left_hip')!),
    ...ancestors(nodes, found.get('right_hip')!),
  ]);
  const chain = ancestors(nodes, top);
  const fork = chain.findIndex((node) => below.has(node));
  const spine = chain.slice(0, Math.max(0, fork)).reverse();
  const hasSmplTrunk = convention.trunk !== undefined;
  return { convention: convention.name, nodes: found, hasSmplTrunk, spine };
}
