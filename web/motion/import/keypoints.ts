import { withoutGaps } from './gaps';
import { type About, type Positions, sourceOfPositions } from './positions';
import type { MotionSource } from '../retarget/source';
import { BALL_SHARE, HEAD_SHARE, NECK_UP } from '../skeleton/landmarks';
import { type Side, SIDES } from '../skeleton/skeleton';
import { lerp, readVec, type Vec3, writeVec } from '../math/vec3';

/** Points of a side that are joints as they are. */
const LIMBS = ['shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle'] as const;
/** Names of the tip of the toes. */
const TOES = ['footindex', 'bigtoe'];
/** Joints that are not seen in pictures: with one of them, neck and head are joints as well. */
const SKELETON = /spine|chest|thorax|collar|clavicle/;

/** A name in lower case without punctuation and what FreeMoCap writes before it. */
const wordOf = (name: string): string =>
  name
    .replace(/^body_/i, '')
    .toLowerCase()
    .replaceAll(/[^a-z]/g, '');

/** Indices of the points that are needed; null where these are no such points. */
function pointsOf(names: readonly string[]) {
  const words = names.map(wordOf);
  const indexOf = (side: Side, parts: readonly string[]): number =>
    words.findIndex((word) => parts.some((part) => word === side + part || word === side[0]! + part));
  const pair = (...parts: string[]) => SIDES.map((side) => indexOf(side, parts)) as [number, number];
  const limbs = SIDES.flatMap((side) =>
    LIMBS.map((limb) => ({ name: `${side}_${limb}`, index: indexOf(side, [limb]) })),
  );
  const [ears, nose, top] = [pair('ear'), words.indexOf('nose'), words.indexOf('head')];
  const hasEars = !ears.includes(-1);
  if (!(hasEars || nose >= 0) || limbs.some(({ index }) => index < 0)) return null;
  if (words.some((word) => SKELETON.test(word))) return null;
  const ankles = pair('ankle');
  const feet = pair(...TOES).flatMap((toe, i) =>
    toe < 0 ? [] : [{ name: `${SIDES[i]!}_foot`, ankle: ankles[i]!, toe }],
  );
  return {
    limbs,
    feet,
    hips: pair('hip'),
    shoulders: pair('shoulder'),
    ears: hasEars ? ears : null,
    nose,
    top,
  };
}

/**
 * The joints of a body of which points are given that a detector of poses finds in pictures: ears, nose and tips of the
 * toes, under the names of MediaPipe, COCO, OpenPose or Halpe. Null for other positions.
 */
function jointsOfKeypoints(given: Positions): Positions | null {
  const points = pointsOf(given.joints.map(({ name }) => name));
  if (!points) return null;
  const { limbs, feet, hips, shoulders, ears, nose, top } = points;
  const names = ['neck', 'head', ...[...limbs, ...feet].map(({ name }) => name)];
  const count = given.joints.length;
  const frames = given.places.length / (3 * count);
  const places = new Float32Array(frames * names.length * 3);
  for (let frame = 0; frame < frames; frame++) {
    const at = (index: number): Vec3 => readVec(given.places, frame * count + index);
    const middle = ([left, right]: readonly [number, number]): Vec3 => lerp(at(left), at(right), 0.5);
    const neck = lerp(middle(hips), middle(shoulders), NECK_UP);
    // A head beside a nose is its top, and the ears are half way up.
    const face = top < 0 ? at(nose) : lerp(neck, at(top), 0.5);
    const row = [
      neck,
      lerp(neck, ears ? middle(ears) : face, HEAD_SHARE),
      ...limbs.map(({ index }) => at(index)),
      ...feet.map(({ ankle, toe }) => lerp(at(ankle), at(toe), BALL_SHARE)),
    ];
    row.forEach((place, joint) => writeVec(places, frame * names.length + joint, place));
  }
  return { joints: names.map((name) => ({ name, parent: -1 })), places };
}

/**
 * A source of points over time: of joints, or of what detectors of poses see. Gaps (not a number) are closed.
 *
 * @throws {AppError} `too-few-frames`
 */
export function sourceOfPoints(given: Positions, about: About): MotionSource {
  const { warnings, ...whole } = withoutGaps(given);
  const keypoints = jointsOfKeypoints(whole);
  return sourceOfPositions(keypoints ?? whole, {
    ...about,
    ...(keypoints ? { convention: 'pose landmarks' } : {}),
    warnings: [...(about.warnings ?? []), ...warnings],
  });
}
