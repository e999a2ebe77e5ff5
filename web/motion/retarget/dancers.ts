import { mapJoints } from './joint-map';
import { worldPose } from './sample';
import type { LocalPoses, MotionSource } from './source';

/** The joints below a root, itself included, in the order of the file. */
function below(source: MotionSource, root: number): number[] {
  const inside = new Set([root]);
  source.joints.forEach(({ parent }, joint) => {
    if (inside.has(parent)) inside.add(joint);
  });
  return [...inside].sort((a, b) => a - b);
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

/** Fewest joints below a root that may be a dancer. */
const MIN_JOINTS = 12;

/**
 * One dancer of a file with several roots; as it is where at most one of them carries a body. A prop beside the only
 * dancer is left out.
 *
 * @param part number of the dancer among those found
 * @param moves whether a joint is animated; bodies that stand still are left out, unless all of them do
 */
export function pickDancer(
  source: MotionSource,
  part: number,
  moves: (joint: number) => boolean = () => true,
): MotionSource {
  const roots = source.joints.flatMap(({ parent }, joint) => (parent < 0 ? [joint] : []));
  if (roots.length < 2) return source;
  const bodies = roots
    .map((root) => ({ root, joints: below(source, root) }))
    .filter(({ joints }) => joints.length >= MIN_JOINTS && hasBody(withJoints(source, joints)));
  const moving = bodies.filter(({ joints }) => joints.some(moves));
  const dancers = moving.length > 0 ? moving : bodies;
  const chosen = dancers[part] ?? dancers[0];
  if (chosen === undefined) return source;
  const parts = dancers.map(({ root }) => source.joints[root]!.name);
  return { ...withJoints(source, chosen.joints), parts, part: dancers.indexOf(chosen) };
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

function hasBody({ joints, rest }: MotionSource): boolean {
  try {
    mapJoints(joints, worldPose(joints, rest, 0).places);
    return true;
  } catch {
    return false;
  }
}
