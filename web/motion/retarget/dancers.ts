import { ancestors, mapJoints } from './joint-map';
import { worldPose } from './sample';
import type { LocalPoses, MotionSource, SourceJoint } from './source';
import { distance, type Vec3 } from '../math/vec3';

/** The joints below a joint, itself included, in the order of the file. */
function below(children: readonly (readonly number[])[], top: number): number[] {
  const inside = [top];
  for (const joint of inside) for (const child of children[joint]!) inside.push(child);
  return inside.sort((a, b) => a - b);
}

/** The source with only some joints; a kept joint's ancestors are kept too. */
function withJoints(source: MotionSource, kept: readonly number[]): MotionSource {
  const places = new Map(kept.map((joint, place) => [joint, place]));
  const count = source.joints.length;
  const pick = ({ rotations, translations }: LocalPoses): LocalPoses => {
    const frames = translations.length / 3 / count;
    const out = {
      rotations: new Float32Array(frames * kept.length * 4),
      translations: new Float32Array(frames * kept.length * 3),
    };
    for (let frame = 0; frame < frames; frame++) {
      kept.forEach((joint, place) => {
        const [from, to] = [frame * count + joint, frame * kept.length + place];
        out.rotations.set(rotations.subarray(4 * from, 4 * from + 4), 4 * to);
        out.translations.set(translations.subarray(3 * from, 3 * from + 3), 3 * to);
      });
    }
    return out;
  };
  return {
    ...source,
    joints: kept.map((joint) => {
      const { name, parent, endSite } = source.joints[joint]!;
      return { name, endSite, parent: parent < 0 ? -1 : places.get(parent)! };
    }),
    rest: pick(source.rest),
    localPoses: (frames) => pick(source.localPoses(frames)),
  };
}

/** Fewest joints below a joint that may be a dancer. */
const MIN_JOINTS = 12;
/** Most objects within one another that each hold several things of so many joints; deeper, nobody is looked for. */
const MAX_FORKS = 4;
/** Least share of the thigh of a whole that the thigh of a dancer within it has: five fingers can look like a body. */
const MIN_THIGH_SHARE = 0.4;

/** A body in a file. */
interface Body {
  /** The joint on which all of it hangs. */
  readonly top: number;
  readonly joints: readonly number[];
  /** Length of a thigh at rest, in the file's unit. */
  readonly thigh: number;
}

/** The bodies in a file: what hangs on a root, or on an object below it where that holds several bodies. */
function bodiesOf({ joints, rest }: MotionSource): Body[] {
  const { places } = worldPose(joints, rest, 0);
  const children = joints.map((): number[] => []);
  const roots: number[] = [];
  joints.forEach(({ parent }, joint) => (children[parent] ?? roots).push(joint));
  const counts = joints.map(() => 1);
  for (let joint = joints.length - 1; joint >= 0; joint--)
    if (joints[joint]!.parent >= 0) counts[joints[joint]!.parent]! += counts[joint]!;
  const large = (of: readonly number[]): number[] => of.filter((joint) => counts[joint]! >= MIN_JOINTS);

  // A joint is in one body of each fork at most, so that the work grows as the number of joints does.
  const among = (tops: readonly number[], forks: number): Body[] =>
    large(tops).flatMap((top) => {
      const inside = below(children, top);
      const thigh = thighOf(joints, places, inside);
      const whole = thigh === null ? [] : [{ top, joints: inside, thigh }];
      let fork = large(children[top]!);
      while (fork.length === 1) fork = large(children[fork[0]!]!);
      if (forks === 0 || fork.length === 0) return whole;
      const parts = among(fork, forks - 1).filter((part) => part.thigh >= MIN_THIGH_SHARE * (thigh ?? 0));
      return parts.length > 1 || thigh === null ? parts : whole;
    });
  return among(roots, MAX_FORKS);
}

/**
 * One dancer of a file with several, who are below roots or objects of their own; as it is where it has one root and at
 * most one body. A prop beside the only dancer is left out.
 *
 * @param part number of the dancer among those found
 * @param moves whether a joint is animated; bodies that stand still are left out, unless all of them do
 */
export function pickDancer(
  source: MotionSource,
  part: number,
  moves: (joint: number) => boolean = () => true,
): MotionSource {
  const bodies = bodiesOf(source);
  if (bodies.length < 2 && source.joints.filter(({ parent }) => parent < 0).length < 2) return source;
  const moving = bodies.filter(({ joints }) => joints.some(moves));
  const dancers = moving.length > 0 ? moving : bodies;
  const chosen = dancers[part] ?? dancers[0];
  if (chosen === undefined) return source;
  const parts = dancers.map(({ top }) => source.joints[top]!.name);
  const kept = [...ancestors(source.joints, chosen.top).reverse(), ...chosen.joints];
  return { ...withJoints(source, kept), parts, part: dancers.indexOf(chosen) };
}

/**
 * The first dancer of a clip beside other clips, which are what can be chosen; a warning names the dancers who are left
 * out. Arguments as of `pickDancer`.
 */
export function pickFirstDancer(source: MotionSource, moves: (joint: number) => boolean): MotionSource {
  const first = pickDancer(source, 0, moves);
  if (first === source) return source;
  const [name, ...others] = first.parts;
  const leftOut = others.map((other) => `“${other}”`).join(', ');
  const warning =
    `“${source.parts[source.part]!}” moves ${first.parts.length} dancers; “${name!}” was read, not ${leftOut}. ` +
    'To choose among them, export this motion alone.';
  const { parts, part, warnings } = source;
  return { ...first, parts, part, warnings: others.length > 0 ? [...warnings, warning] : warnings };
}

/** Length of the left thigh of the body that some joints are; null where they are none. */
function thighOf(
  joints: readonly SourceJoint[],
  places: readonly Vec3[],
  inside: readonly number[],
): number | null {
  const index = new Map(inside.map((joint, place) => [joint, place]));
  const ours = inside.map((joint) => ({ ...joints[joint]!, parent: index.get(joints[joint]!.parent) ?? -1 }));
  const own = inside.map((joint) => places[joint]!);
  try {
    const { nodes } = mapJoints(ours, own);
    return distance(own[nodes.get('left_hip')!]!, own[nodes.get('left_knee')!]!);
  } catch {
    return null;
  }
}
