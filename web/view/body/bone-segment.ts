import { J, type JointName } from '../../motion/skeleton/skeleton';
import { length, sub, type Vec3, smoothstep } from '../../motion/math/vec3';
import { unit, type Field, type LimbShape } from './field';
import { limbPart, scaledToBuild, type Blend, type Build, type Part, type Side, type Weights } from './part';

type PairedJoint<Name = JointName> = Name extends `left_${infer Joint}` ? Joint : never;

/** The joint of one side of the body. */
export const jointOf = (side: Side, joint: PairedJoint): number =>
  side > 0 ? J[`left_${joint}`] : J[`right_${joint}`];

/** Skin weights that go from joint `a` to joint `b` while `share` goes from 0 to 1. */
export const blendWeights = (a: number, b: number, share: number): Weights =>
  share <= 0
    ? [[a, 1]]
    : share >= 1
      ? [[b, 1]]
      : [
          [a, 1 - share],
          [b, share],
        ];

/** Length of a bone, and a field of how far along it a point lies, metres. */
export function alongBone(from: Vec3, to: Vec3): { span: number; down: Field } {
  const [ax, ay, az] = unit(sub(to, from));
  const start = from[0] * ax + from[1] * ay + from[2] * az;
  return { span: length(sub(to, from)), down: (x, y, z) => x * ax + y * ay + z * az - start };
}

/** Share of the next joint as a function of the distance beyond a joint along the bone, metres. */
type ShareBeyond = (past: number) => number;

/** At a hinge such as a knee: half at the joint, so that it bends over `width` metres on both sides of it. */
export const hinge =
  (width: number): ShareBeyond =>
  (past) =>
    0.5 * smoothstep(-width, 0, past) + 0.5 * smoothstep(0, width, past);

/** From 0 to 1 between two distances beyond the joint. */
export const gradual =
  (from: number, to: number): ShareBeyond =>
  (past) =>
    smoothstep(from, to, past);

interface SegmentShape extends LimbShape {
  /** Joints that move the segment: the one before it, its own, and the one after it. */
  readonly joints: readonly [before: number, own: number, after: number];
  /** Share of its own joint around its start, and of the joint after it around its end. */
  readonly shares: readonly [start: ShareBeyond, end: ShareBeyond];
  /** Width of the union with the body: the same all along, or falling to almost nothing away from the start, metres. */
  readonly blend:
    number | { readonly atStart: number; readonly beyond: number; readonly over: readonly [number, number] };
}

/** A piece of a limb around one bone, at the breadth of a build. */
export function boneSegment(
  build: Build,
  { joints: [before, own, after], shares, blend, ...shape }: SegmentShape,
): Part {
  const { span, down } = alongBone(shape.from, shape.to);
  const [atStart, atEnd] = shares;
  return limbPart(
    { ...shape, stations: scaledToBuild(build, shape.stations) },
    typeof blend === 'number' ? blend : fading(blend, down),
    (x, y, z) => {
      const past = down(x, y, z);
      return past < span / 2
        ? blendWeights(before, own, atStart(past))
        : blendWeights(own, after, atEnd(past - span));
    },
  );
}

/** A blend width that falls from one value to another while a point goes `over` these distances down the bone. */
const fading = ({ atStart, beyond, over }: Exclude<SegmentShape['blend'], number>, down: Field): Blend => ({
  max: atStart,
  at: (x, y, z) => atStart + (beyond - atStart) * smoothstep(over[0], over[1], down(x, y, z)),
});
