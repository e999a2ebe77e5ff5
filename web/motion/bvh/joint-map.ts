import { BVH_NAMES } from './joint-names';
import type { BvhNode } from './hierarchy';
import { type Dialect, DIALECTS, isOwn, LIMB_JOINTS, type LimbJoint, OWN_DIALECT } from './conventions';
import { AppError } from '../../common/error';
import { type JointName, SMPL22 } from '../skeleton/skeleton';

/** Which node of a file is which joint. */
export interface JointMap {
  readonly dialect: string;
  /** Node of every joint that the file has; the others are filled by rule. */
  readonly nodes: ReadonlyMap<JointName, number>;
  /** Does the file have the very trunk of our skeleton, so that pelvis and spine need no rule? */
  readonly ownTrunk: boolean;
  /** Nodes between the hips and the neck, upwards: the bend of the back. */
  readonly back: readonly number[];
}

/** What the joint of a limb is called in our skeleton. */
const OURS: Readonly<Record<LimbJoint, string>> = {
  hip: 'hip',
  knee: 'knee',
  ankle: 'ankle',
  toe: 'foot',
  shoulder: 'shoulder',
  elbow: 'elbow',
  wrist: 'wrist',
  collar: 'collar',
};
/** The joints of the trunk, which nearly every family of programs puts elsewhere. */
export const TRUNK_JOINTS: readonly JointName[] = ['pelvis', 'spine1', 'spine2', 'spine3'];
const LEG: readonly LimbJoint[] = ['hip', 'knee', 'ankle'];
const ARM: readonly LimbJoint[] = ['shoulder', 'elbow', 'wrist'];
const FINDABLE = new Set<LimbJoint>([...LEG, ...ARM]);

function plain(name: string, dialect: Dialect): string | null {
  if (dialect.prefix !== undefined) {
    return dialect.prefix.test(name) ? plainWord(name.replace(dialect.prefix, '')) : null;
  }
  return plainWord(name);
}

function plainWord(name: string): string {
  return name
    .replace(/^.*[:|]/, '')
    .replace(/^DEF-/, '')
    .toLowerCase()
    .replaceAll(/[^a-z0-9]/g, '');
}

/** Joints that a dialect finds among the nodes; no node is two joints. */
function find(
  nodes: readonly BvhNode[],
  dialect: Dialect,
  sides: readonly [string, string],
): Map<JointName, number> {
  const found = new Map<JointName, number>();
  const byName = new Map<string, number>();
  nodes.forEach((node, index) => {
    const word = node.endSite ? null : plain(node.name, dialect);
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
        `${side}_${OURS[limb]}` as JointName,
        dialect.limbs[limb].map((word) => word.replace('*', sides[i]!)),
      );
    });
  }
  take('neck', dialect.neck);
  take('head', dialect.head);
  TRUNK_JOINTS.forEach((joint, i) => dialect.trunk && take(joint, [dialect.trunk[i]!]));
  return found;
}

/** How many of the joints that cannot be guessed were found; a family with our trunk must have that trunk. */
function score(dialect: Dialect, found: ReadonlyMap<JointName, number>): number {
  if (dialect.trunk !== undefined && !TRUNK_JOINTS.every((joint) => found.has(joint))) return 0;
  const limbs = [...FINDABLE].flatMap((limb) => [`left_${OURS[limb]}`, `right_${OURS[limb]}`] as JointName[]);
  return limbs.filter((joint) => found.has(joint)).length + (found.has('head') || found.has('neck') ? 1 : 0);
}

function ancestors(nodes: readonly BvhNode[], node: number): number[] {
  const chain: number[] = [];
  for (let at = nodes[node]!.parent; at >= 0; at = nodes[at]!.parent) chain.push(at);
  return chain;
}

/** Says what a body lacks, whole limbs before single joints. */
function missingJoints(nodes: readonly BvhNode[], found: ReadonlyMap<JointName, number>): AppError | null {
  const lacks = (limb: readonly LimbJoint[]): string[] =>
    ['left', 'right'].flatMap((side) =>
      limb
        .filter((joint) => !found.has(`${side}_${OURS[joint]}` as JointName))
        .map((joint) => `${side} ${joint}`),
    );
  const [legs, arms] = [lacks(LEG), lacks(ARM)];
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
 * Finds our joints among the nodes of a file by the names of the dialect that fits best.
 *
 * @throws {AppError} `missing-joints` when a limb's joint or both neck and head cannot be found
 */
export function mapJoints(nodes: readonly BvhNode[]): JointMap {
  const names = nodes.filter(({ endSite }) => !endSite).map(({ name }) => name);
  if (isOwn(names)) {
    const own = new Map(
      SMPL22.map((joint) => [
        joint,
        nodes.findIndex(({ name, endSite }) => !endSite && name === BVH_NAMES[joint]),
      ]),
    );
    return { dialect: OWN_DIALECT, nodes: own, ownTrunk: true, back: [] };
  }
  let best: { dialect: Dialect; found: Map<JointName, number> } | null = null;
  for (const dialect of DIALECTS) {
    for (const sides of dialect.sides) {
      const found = find(nodes, dialect, sides);
      if (best === null || score(dialect, found) > score(best.dialect, best.found)) best = { dialect, found };
    }
  }
  const { dialect, found } = best!;
  const error = missingJoints(nodes, found);
  if (error) throw error;

  const top = found.get('neck') ?? found.get('head')!;
  const below = new Set([
    ...ancestors(nodes, found.get('left_hip')!),
    ...ancestors(nodes, found.get('right_hip')!),
  ]);
  const chain = ancestors(nodes, top);
  const fork = chain.findIndex((node) => below.has(node));
  const back = chain.slice(0, Math.max(0, fork)).reverse();
  const ownTrunk = dialect.trunk !== undefined;
  return { dialect: dialect.name, nodes: found, ownTrunk, back };
}
