import type { SourceJoint } from './source';
import type { JointName } from '../skeleton/skeleton';
import { cross, direction, distance, dot, length, lerp, sub, type Vec3, ZERO } from '../math/vec3';

/** A body that was found by its shape, whatever its joints are called. */
export interface StructuralMap {
  readonly nodes: ReadonlyMap<JointName, number>;
  /** Whether feet or names tell left from right. */
  readonly sidesCertain: boolean;
  /** Whether names say left where the feet say right. */
  readonly sidesDisputed: boolean;
  /** Lengths of leg and arm as shares of the trunk, by those of a person: 1 is usual. */
  readonly shares: { readonly legs: number; readonly arms: number };
  /** How alike the limbs of the two sides are, 0 to 1. */
  readonly symmetry: number;
}

/** Two chains of joints from one joint outwards that are as long as one another: legs or arms. */
interface Pair {
  readonly chains: readonly [readonly number[], readonly number[]];
  /** Places in each chain of the joints that end the two long bones: hip, knee, ankle or shoulder, elbow, wrist. */
  readonly limbs: readonly [Limb, Limb];
  readonly fork: number;
  readonly symmetry: number;
}

interface Limb {
  /** Place in the chain of the hip or shoulder; the two joints after it follow. */
  readonly start: number;
  readonly length: number;
}

/** Least ratio of the shorter of two limbs to the longer one. */
const MIN_SYMMETRY = 0.85;
/** Least ratio of the lengths of thigh and shin, or of upper arm and forearm. */
const MIN_BONE_RATIO = 0.55;
/**
 * Least ratio of the distances at which two limbs end beside the trunk: a limb and a neck, or a limb and a tail, are none
 * of one pair.
 */
const MIN_SPREAD_RATIO = 0.25;
/** Lengths of leg and arm as shares of the trunk between the middle of the hips and that of the shoulders. */
const LEG_SHARE = 1.6;
const ARM_SHARE = 1.05;
/** Largest natural logarithm by which a share may be off. */
const MAX_SHARE_ERROR = 0.9;
/** Most pairs of chains that are compared with one another: a cloak or a tail has many that are no limbs. */
const MAX_PAIRS = 60;
/** Most joints of a chain that are looked at: a file may have chains of thousands. */
const MAX_CHAIN = 60;

/** What is known about the tree of joints. */
interface Tree {
  readonly names: readonly string[];
  readonly places: readonly Vec3[];
  readonly children: readonly (readonly number[])[];
  /** The child with which the longest way from each joint outwards begins; none for a tip. */
  readonly longest: readonly (number | undefined)[];
}

function treeOf(joints: readonly SourceJoint[], places: readonly Vec3[]): Tree {
  const children: number[][] = joints.map(() => []);
  joints.forEach(({ parent }, joint) => children[parent]?.push(joint));
  const reach = joints.map(() => 0);
  const longest: (number | undefined)[] = joints.map(() => undefined);
  for (let joint = joints.length - 1; joint >= 0; joint--) {
    for (const child of children[joint]!) {
      const far = distance(places[joint]!, places[child]!) + reach[child]!;
      if (longest[joint] !== undefined && far <= reach[joint]!) continue;
      reach[joint] = far;
      longest[joint] = child;
    }
  }
  const names = joints.map(({ name }) => name);
  return { names, places, children, longest };
}

/** The joints of the longest way outwards from a joint, itself first. */
function mainChain({ longest }: Tree, joint: number): number[] {
  const chain = [joint];
  while (chain.length < MAX_CHAIN) {
    const next = longest[chain.at(-1)!];
    if (next === undefined) break;
    chain.push(next);
  }
  return chain;
}

/** The two longest bones that follow one another in a chain: thigh and shin, or upper arm and forearm. */
function limbOf({ places }: Tree, chain: readonly number[]): Limb | null {
  const bone = (at: number): number => distance(places[chain[at]!]!, places[chain[at + 1]!]!);
  let best: Limb | null = null;
  let longest = 0;
  for (let start = 0; start + 2 < chain.length; start++) {
    const [shorter, longer] = [bone(start), bone(start + 1)].sort((a, b) => a - b) as [number, number];
    if (shorter <= longest || shorter < MIN_BONE_RATIO * longer) continue;
    longest = shorter;
    best = { start, length: bone(start) + bone(start + 1) };
  }
  return best;
}

/** A name without what tells the halves of a bone from one another: numbers, and words such as roll. */
const stemOf = (name: string): string => name.toLowerCase().replaceAll(/roll|twist|[^\p{L}]/gu, '');

/** A chain as it is, and without the second halves of bones: `upperleg02.L` after `upperleg01.L`, `LegRoll` after `Leg`. */
function readingsOf(tree: Tree, chain: readonly number[]): (readonly number[])[] {
  const stems = chain.map((joint) => stemOf(tree.names[joint]!));
  const whole = chain.filter((_, at) => at === 0 || stems[at] !== stems[at - 1]);
  return whole.length < chain.length ? [chain, whole] : [chain];
}

function pairsAt(tree: Tree, fork: number): Pair[] {
  if (tree.children[fork]!.length < 2) return [];
  const limbs = tree.children[fork]!.flatMap((child) =>
    readingsOf(tree, mainChain(tree, child)).flatMap((chain) => {
      const limb = limbOf(tree, chain);
      return limb ? [{ chain, limb }] : [];
    }),
  );
  return limbs.flatMap((a, i) =>
    limbs.slice(i + 1).flatMap((b): Pair[] => {
      const symmetry = Math.min(a.limb.length, b.limb.length) / Math.max(a.limb.length, b.limb.length);
      if (!(symmetry >= MIN_SYMMETRY) || a.limb.start !== b.limb.start) return [];
      if (a.chain[0] === b.chain[0]) return [];
      return [{ chains: [a.chain, b.chain], limbs: [a.limb, b.limb], fork, symmetry }];
    }),
  );
}

/** Joint of a limb: 0 is the hip or shoulder, 1 and 2 the next two, 3 what follows, if anything does. */
const limbJoint = ({ chains, limbs }: Pair, side: 0 | 1, at: number): number | undefined =>
  chains[side][limbs[side].start + at];

/** The middle between the two sides of a joint of a limb. */
function middle(tree: Tree, pair: Pair, at: number): Vec3 {
  const [a, b] = [limbJoint(pair, 0, at)!, limbJoint(pair, 1, at)!];
  return lerp(tree.places[a]!, tree.places[b]!, 0.5);
}

/** Whether the ends of both limbs are beside the line of the trunk, about equally far from it. */
function isMirrored(tree: Tree, pair: Pair, hips: Vec3, trunk: Vec3): boolean {
  const away = ([0, 1] as const).map((side) =>
    length(cross(sub(tree.places[limbJoint(pair, side, 2)!]!, hips), direction(trunk, ZERO))),
  );
  return Math.min(...away) >= MIN_SPREAD_RATIO * Math.max(...away);
}

/** Lengths of leg and arm as shares of the trunk, by those of a person. */
function sharesOf(tree: Tree, legs: Pair, arms: Pair): StructuralMap['shares'] {
  const size = distance(middle(tree, arms, 0), middle(tree, legs, 0));
  const share = ({ limbs }: Pair): number => (limbs[0].length + limbs[1].length) / 2 / size;
  return { legs: share(legs) / LEG_SHARE, arms: share(arms) / ARM_SHARE };
}

/** How unlike a body legs and arms are; null where they can't be one. */
function misfit(tree: Tree, legs: Pair, arms: Pair): number | null {
  if (legs.chains.some((chain) => chain.some((joint) => arms.chains.flat().includes(joint)))) return null;
  if (legs.chains.some((chain) => chain.includes(arms.fork))) return null;
  const trunk = sub(middle(tree, arms, 0), middle(tree, legs, 0));
  if (!(length(trunk) > 0)) return null;
  if ([legs, arms].some((pair) => !isMirrored(tree, pair, middle(tree, legs, 0), trunk))) return null;
  const errors = Object.values(sharesOf(tree, legs, arms)).map((share) => Math.abs(Math.log(share)));
  if (errors.some((error) => !(error <= MAX_SHARE_ERROR))) return null;
  const down = direction(sub(middle(tree, legs, 2), middle(tree, legs, 0)), ZERO);
  // Legs go on from the trunk; a seated rest pose has them level with the floor.
  const bend = dot(down, direction(trunk, ZERO));
  if (bend > 0.3) return null;
  return errors[0]! + errors[1]! + (1 + bend) + 2 * (2 - legs.symmetry - arms.symmetry);
}

/** Neck and head: the way from the arms' fork that goes on from the trunk and is none of the limbs. */
function neckAndHead(
  joints: readonly SourceJoint[],
  tree: Tree,
  legs: Pair,
  arms: Pair,
): { neck?: number; head?: number } {
  const trunk = direction(sub(middle(tree, arms, 0), middle(tree, legs, 0)), ZERO);
  const limbs = new Set([...arms.chains, ...legs.chains].map(([first]) => first));
  // Hair may hang down from a head, so that either the joint or the tip beyond it goes on.
  const towards = (place: Vec3): number => dot(direction(sub(place, tree.places[arms.fork]!), ZERO), trunk);
  const along = (child: number): number => Math.max(towards(tree.places[child]!), towards(tip(tree, child)));
  const [up] = tree.children[arms.fork]!.filter((child) => !limbs.has(child)).toSorted(
    (a, b) => along(b) - along(a),
  );
  if (up === undefined || along(up) < 0.5) return {};
  const chain = [up];
  // The head is where the neck's single way ends, or divides into eyes and hair.
  for (;;) {
    const [next, ...others] = tree.children[chain.at(-1)!]!;
    if (next === undefined || others.length > 0) break;
    chain.push(next);
  }
  // The crown of a head has no joint of its own in some formats; where there are three joints, the last one is it.
  const last = chain.at(-1)!;
  const endsInCrown = tree.children[last]!.length === 0 && (joints[last]!.endSite || chain.length > 2);
  if (endsInCrown) chain.pop();
  if (chain.length === 0) return {};
  return chain.length > 1 ? { neck: chain[0]!, head: chain.at(-1)! } : { head: up };
}

/** The outer end of what hangs on a joint. */
const tip = (tree: Tree, joint: number): Vec3 => tree.places[mainChain(tree, joint).at(-1)!]!;

const LEFT_WORDS = /left|links?|gauche|izq|sinistr|esquerd|左|(^|[^a-z])l([^a-z]|$)|^l[A-Z]|[a-z]L$/;
const RIGHT_WORDS = /right|rechts?|droite|derech|destr|direit|右|(^|[^a-z])r([^a-z]|$)|^r[A-Z]|[a-z]R$/;

/** 1 where the first chain is the left one by its names, -1 where it is the right one, 0 where names do not tell. */
function sideByName(joints: readonly SourceJoint[], pair: Pair): number {
  const votes = (chain: readonly number[], words: RegExp): number =>
    chain.filter((joint) => words.test(joints[joint]!.name) || words.test(joints[joint]!.name.toLowerCase()))
      .length;
  const [first, second] = pair.chains;
  return Math.sign(
    votes(first, LEFT_WORDS) -
      votes(first, RIGHT_WORDS) +
      votes(second, RIGHT_WORDS) -
      votes(second, LEFT_WORDS),
  );
}

/** The same by place, given the direction of the body's left. */
function sideByPlace(tree: Tree, pair: Pair, left: Vec3): number {
  const [a, b] = [limbJoint(pair, 0, 1)!, limbJoint(pair, 1, 1)!];
  return Math.sign(dot(sub(tree.places[a]!, tree.places[b]!), left));
}

/** The direction of the body's left in the rest pose, from its feet; null without feet. */
function leftOf(tree: Tree, legs: Pair, arms: Pair): Vec3 | null {
  const up = direction(sub(middle(tree, arms, 0), middle(tree, legs, 0)), ZERO);
  if (([0, 1] as const).some((side) => limbJoint(legs, side, 3) === undefined)) return null;
  const foot = sub(middle(tree, legs, 3), middle(tree, legs, 2));
  const ahead = sub(foot, [up[0] * dot(foot, up), up[1] * dot(foot, up), up[2] * dot(foot, up)]);
  return length(ahead) > 0.03 * legs.limbs[0].length ? cross(up, direction(ahead, ZERO)) : null;
}

/**
 * Finds a body by its shape alone: two legs and two arms of equal length at the ends of a trunk, and a head.
 *
 * @param places rest position of every joint
 * @returns null where there is no such shape
 */
export function mapByStructure(
  joints: readonly SourceJoint[],
  places: readonly Vec3[],
): StructuralMap | null {
  const tree = treeOf(joints, places);
  const pairs = joints
    .flatMap((_, joint) => pairsAt(tree, joint))
    .toSorted((a, b) => b.limbs[0].length - a.limbs[0].length)
    .slice(0, MAX_PAIRS);
  let best: { legs: Pair; arms: Pair; error: number } | null = null;
  for (const legs of pairs) {
    for (const arms of pairs) {
      const error = legs === arms ? null : misfit(tree, legs, arms);
      if (error !== null && (best === null || error < best.error)) best = { legs, arms, error };
    }
  }
  if (best === null) return null;
  const { legs, arms } = best;
  const left = leftOf(tree, legs, arms);
  const nodes = new Map<JointName, number>();
  let sidesCertain = true;
  let sidesDisputed = false;
  const put = (pair: Pair, names: readonly string[]): void => {
    const byPlace = left ? sideByPlace(tree, pair, left) : 0;
    const byName = sideByName(joints, pair);
    const side = byPlace || byName;
    if (byPlace * byName < 0) sidesDisputed = true;
    if (side === 0) sidesCertain = false;
    names.forEach((name, at) => {
      if (name === '') return;
      const [a, b] = [limbJoint(pair, 0, at - 1), limbJoint(pair, 1, at - 1)];
      if (a === undefined || b === undefined) return;
      nodes.set(`left_${name}` as JointName, side < 0 ? b : a);
      nodes.set(`right_${name}` as JointName, side < 0 ? a : b);
    });
  };
  put(legs, ['', 'hip', 'knee', 'ankle', 'foot']);
  put(arms, ['collar', 'shoulder', 'elbow', 'wrist']);
  const { neck, head } = neckAndHead(joints, tree, legs, arms);
  if (neck !== undefined) nodes.set('neck', neck);
  if (head !== undefined) nodes.set('head', head);
  const symmetry = Math.min(legs.symmetry, arms.symmetry);
  return { nodes, sidesCertain, sidesDisputed, shares: sharesOf(tree, legs, arms), symmetry };
}
