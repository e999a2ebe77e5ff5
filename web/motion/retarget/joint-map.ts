import type { LimbJoint } from './conventions';
import { ARM, bestConvention, jointOf, LEG, TRUNK_JOINTS } from './joint-names';
import type { JointChoice } from './options';
import type { SourceJoint } from './source';
import { mapByStructure } from './structure';
import { BVH_NAMES, isOwnSkeleton, OWN_CONVENTION } from '../bvh/names';
import { AppError } from '../../common/error';
import { type JointName, otherSide, SIDES, SMPL22 } from '../skeleton/skeleton';
import { distance, type Vec3 } from '../math/vec3';

/** How joints were found: by their names, by the shape of the body, or set by hand. */
export type MappedBy = 'names' | 'structure' | 'hand';

/** The joint of a file for each of the 22 joints. */
export interface JointMap {
  /** Name of the skeleton convention. */
  readonly convention: string;
  readonly by: MappedBy;
  /** How certain the map is, 0 to 1. */
  readonly confidence: number;
  /** Why it is not certain, as sentences. */
  readonly doubts: readonly string[];
  /** Every joint that the file has; the others are estimated. */
  readonly nodes: ReadonlyMap<JointName, number>;
  /** Whether the file has exactly the trunk of the SMPL skeleton, so that pelvis and spine are not estimated. */
  readonly hasSmplTrunk: boolean;
  /** Joints of the spine between the hips and the neck, upwards. */
  readonly spine: readonly number[];
}

/** The joints above a joint, the nearest first. */
export function ancestors(nodes: readonly SourceJoint[], node: number): number[] {
  const chain: number[] = [];
  for (let at = nodes[node]!.parent; at >= 0; at = nodes[at]!.parent) chain.push(at);
  return chain;
}

/** The error that names the missing joints, whole limbs before single joints; null when none is missing. */
function missingJoints(
  nodes: readonly SourceJoint[],
  found: ReadonlyMap<JointName, number>,
): AppError | null {
  const missingOf = (limb: readonly LimbJoint[]): string[] =>
    SIDES.flatMap((side) =>
      limb.filter((joint) => !found.has(jointOf(side, joint))).map((joint) => `${side} ${joint}`),
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
    `Its joints are called ${seen}. Say which joint is which under “Joints and units”, or export a whole body.`,
  );
}

/** A way in which joints were found. */
type Found = Pick<JointMap, 'convention' | 'by' | 'confidence' | 'doubts' | 'hasSmplTrunk'> & {
  readonly nodes: Map<JointName, number>;
};

/** The last joint of the single way that goes on from a neck, as `Neck1` after `Neck`; undefined where none does. */
function aboveNeck(nodes: readonly SourceJoint[], neck: number | undefined): number | undefined {
  let last: number | undefined;
  for (let at = neck; at !== undefined;) {
    const above = [...nodes.keys()].filter((node) => nodes[node]!.parent === at && !nodes[node]!.endSite);
    at = above.length === 1 ? above[0] : undefined;
    last = at ?? last;
  }
  return last;
}

/** The joints by the names of the convention of which most are found. */
function findByNames(nodes: readonly SourceJoint[]): Found {
  const { convention, found } = bestConvention(nodes);
  const head = found.has('head') ? undefined : aboveNeck(nodes, found.get('neck'));
  if (head !== undefined) found.set('head', head);
  const hasSmplTrunk = convention.trunk !== undefined;
  return { convention: convention.name, by: 'names', confidence: 1, doubts: [], nodes: found, hasSmplTrunk };
}

/** Certainty of a body that was found by its shape, and of one whose sides are a guess. */
const SHAPE_CONFIDENCE = 0.8;
const SIDES_CONFIDENCE = 0.5;

/** Largest ratio by which legs and arms that were found by the shape differ from those of a person without a doubt. */
const MAX_SHARE = 1.6;

/** The joints by the shape of the body; null where it has none. */
function findByStructure(nodes: readonly SourceJoint[], places: readonly Vec3[]): Found | null {
  const found = mapByStructure(nodes, places);
  if (found === null) return null;
  const doubts = ['Not all joints have known names; the body was found by its shape.'];
  if (!found.sidesCertain) doubts.push('Nothing tells left from right in this file; they may be exchanged.');
  if (found.sidesDisputed) doubts.push('Names and feet disagree about left and right; the feet were used.');
  for (const [limbs, share] of Object.entries(found.shares)) {
    if (share >= 1 / MAX_SHARE && share <= MAX_SHARE) continue;
    const size = share < 1 ? 'short' : 'long';
    doubts.push(
      `The ${limbs} are too ${size} for the trunk: a joint within a bone may have been taken for one at its end.`,
    );
  }
  return {
    convention: 'found by shape',
    by: 'structure',
    confidence: SHAPE_CONFIDENCE * found.symmetry * (found.sidesCertain ? 1 : SIDES_CONFIDENCE),
    doubts,
    nodes: new Map(found.nodes),
    hasSmplTrunk: false,
  };
}

/** Long bones of a limb, by the joints at their ends. */
const BONES = [
  ['thigh', 'hip', 'knee'],
  ['shin', 'knee', 'ankle'],
  ['upper arm', 'shoulder', 'elbow'],
  ['forearm', 'elbow', 'wrist'],
] as const;
/** Largest share by which the bones of the two sides differ in a body that is believed. */
const MAX_ASYMMETRY = 0.15;

/** Doubts about bones of different lengths, and the share of the most unlike ones. */
function asymmetry(
  found: ReadonlyMap<JointName, number>,
  places: readonly Vec3[],
): { doubts: string[]; share: number } {
  const doubts: string[] = [];
  let share = 1;
  for (const [bone, from, to] of BONES) {
    const [left, right] = SIDES.map((side) => {
      const ends = [from, to].map((joint) => found.get(`${side}_${joint}`));
      return ends.includes(undefined) ? NaN : distance(places[ends[0]!]!, places[ends[1]!]!);
    }) as [number, number];
    const ratio = Math.min(left, right) / Math.max(left, right);
    if (!(ratio < 1 - MAX_ASYMMETRY)) continue;
    share = Math.min(share, ratio);
    doubts.push(`The left and the right ${bone} differ in length by ${Math.round(100 * (1 - ratio))} %.`);
  }
  return { doubts, share };
}

/** The joints that were chosen by hand, in place of those that were found. */
function withChoice(nodes: readonly SourceJoint[], found: Found, choice: JointChoice): Found {
  const chosen = new Map(found.nodes);
  for (const [joint, name] of Object.entries(choice) as [JointName, string | null][]) {
    const node = name === null ? -1 : nodes.findIndex((one) => one.name === name);
    if (node < 0) chosen.delete(joint);
    else chosen.set(joint, node);
  }
  const hasSmplTrunk = TRUNK_JOINTS.every((joint) => chosen.has(joint));
  if (!hasSmplTrunk) for (const joint of TRUNK_JOINTS) chosen.delete(joint);
  return { ...found, nodes: chosen, by: 'hand', confidence: 1, doubts: [], hasSmplTrunk };
}

/** A file that `writeBvh` wrote. */
function findOwn(nodes: readonly SourceJoint[]): Found {
  const own = new Map(
    SMPL22.map((joint) => [
      joint,
      nodes.findIndex(({ name, endSite }) => !endSite && name === BVH_NAMES[joint]),
    ]),
  );
  return {
    convention: OWN_CONVENTION,
    by: 'names',
    confidence: 1,
    doubts: [],
    nodes: own,
    hasSmplTrunk: true,
  };
}

/** What can be found without an error, however little; for the panel in which joints are set by hand. */
export function findAnyJoints(
  nodes: readonly SourceJoint[],
  places: readonly Vec3[],
  choice: JointChoice = {},
): Found {
  const names = nodes.filter(({ endSite }) => !endSite).map(({ name }) => name);
  let found = isOwnSkeleton(names) ? findOwn(nodes) : findByNames(nodes);
  if (missingJoints(nodes, found.nodes)) found = findByStructure(nodes, places) ?? found;
  return Object.keys(choice).length > 0 ? withChoice(nodes, found, choice) : found;
}

/**
 * Finds the 22 joints among those of a file: by the names of the convention of which most joints are found, else by the
 * shape of the body. What was chosen by hand is taken before both.
 *
 * @param places rest position of every joint
 * @throws {AppError} `missing-joints` when a limb's joint or both neck and head cannot be found
 */
export function mapJoints(
  nodes: readonly SourceJoint[],
  places: readonly Vec3[],
  choice: JointChoice = {},
): JointMap {
  const found = findAnyJoints(nodes, places, choice);
  const error = missingJoints(nodes, found.nodes);
  if (error) throw error;
  const { doubts, share } = asymmetry(found.nodes, places);
  return {
    ...found,
    confidence: found.confidence * share,
    doubts: [...found.doubts, ...doubts],
    spine: found.convention === OWN_CONVENTION ? [] : spineOf(nodes, found.nodes),
  };
}

/** The joints between the hips and the neck, upwards. */
function spineOf(nodes: readonly SourceJoint[], found: ReadonlyMap<JointName, number>): number[] {
  const top = found.get('neck') ?? found.get('head')!;
  const below = new Set([
    ...ancestors(nodes, found.get('left_hip')!),
    ...ancestors(nodes, found.get('right_hip')!),
  ]);
  const chain = ancestors(nodes, top);
  const fork = chain.findIndex((node) => below.has(node));
  return chain.slice(0, Math.max(0, fork)).reverse();
}

/** The map with the two sides exchanged. */
export function withSidesExchanged(map: JointMap): JointMap {
  return { ...map, nodes: new Map([...map.nodes].map(([joint, node]) => [otherSide(joint), node])) };
}
