import { SOLE } from '../../motion/skeleton/kinematics';
import { J } from '../../motion/skeleton/skeleton';
import { add, dot, length, smoothUnion, smoothstep, scale, sub, unit, type Vec3 } from './field';
import {
  ball,
  hingeShare,
  limbPart,
  blendWeights,
  alongBone,
  scaledToBuild,
  type Part,
  type BodyPlan,
  type Side,
} from './part';

/** Width over which the edge of the sole is rounded, metres. */
const SOLE_EDGE = 0.012;

export function buttock({ at, build }: BodyPlan, side: Side): Part {
  const hip = side > 0 ? J.left_hip : J.right_hip;
  return ball(
    add(at[hip]!, [-side * 0.012, -0.005, -0.05]),
    scale([0.078, 0.072, 0.085], build.width),
    0.05,
    () => blendWeights(J.pelvis, hip, 0.45),
  );
}

export function thigh({ at, build }: BodyPlan, side: Side): Part {
  const [hip, knee] = side > 0 ? [J.left_hip, J.left_knee] : [J.right_hip, J.right_knee];
  const [from, to] = [at[hip]!, at[knee]!];
  const { span, down } = alongBone(from, to);
  return limbPart(
    {
      from,
      to,
      across: [1, 0, 0],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.082, deep: 0.09 },
        { at: 0.4, wide: 0.074, deep: 0.082 },
        { at: 0.78, wide: 0.058, deep: 0.061 },
        { at: 1, wide: 0.046, deep: 0.049 },
      ]),
    },
    { max: 0.066, at: (x, y, z) => 0.066 + (0.006 - 0.066) * smoothstep(0.03, 0.14, down(x, y, z)) },
    (x, y, z) => {
      const u = down(x, y, z);
      return u < span / 2
        ? blendWeights(J.pelvis, hip, smoothstep(-0.07, 0.1, u))
        : blendWeights(hip, knee, hingeShare(u - span, 0.06));
    },
  );
}

export function shin({ at, build }: BodyPlan, side: Side): Part {
  const [knee, ankle] = side > 0 ? [J.left_knee, J.left_ankle] : [J.right_knee, J.right_ankle];
  const [from, to] = [at[knee]!, at[ankle]!];
  const { span, down } = alongBone(from, to);
  const hip = side > 0 ? J.left_hip : J.right_hip;
  return limbPart(
    {
      from,
      to,
      across: [1, 0, 0],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.0455, deep: 0.048 },
        { at: 0.3, wide: 0.0525, deep: 0.0575, shift: -0.014 },
        { at: 0.75, wide: 0.034, deep: 0.035, shift: -0.006 },
        { at: 1, wide: 0.0305, deep: 0.0315 },
      ]),
    },
    0.022,
    (x, y, z) => {
      const u = down(x, y, z);
      return u < span / 2
        ? blendWeights(hip, knee, hingeShare(u, 0.06))
        : blendWeights(knee, ankle, smoothstep(-0.035, 0.025, u - span));
    },
  );
}

export function foot({ at, build }: BodyPlan, side: Side): Part {
  const [knee, ankle, toe] =
    side > 0 ? [J.left_knee, J.left_ankle, J.left_foot] : [J.right_knee, J.right_ankle, J.right_foot];
  const toes = at[toe]!;
  const sole = toes[1] - SOLE;
  const flat = unit([toes[0] - at[ankle]![0], 0, toes[2] - at[ankle]![2]]);
  const heel: Vec3 = add([at[ankle]![0], sole + 0.031, at[ankle]![2]], scale(flat, -0.03));
  const tip: Vec3 = add([toes[0], sole + 0.019, toes[2]], scale(flat, 0.052));
  const across: Vec3 = [flat[2], 0, -flat[0]];
  const span = length(sub(tip, heel));
  const ballAt = dot(sub(toes, heel), unit(sub(tip, heel))) / span;
  const shoe = limbPart(
    {
      from: heel,
      to: tip,
      across,
      stations: [
        { at: 0, wide: 0.032, deep: 0.033 },
        { at: ballAt * 0.55, wide: 0.035, deep: 0.037, shift: -0.004 },
        { at: ballAt, wide: 0.043, deep: 0.0275 },
        { at: 1, wide: 0.03, deep: 0.019 },
      ].map((s) => ({ ...s, wide: s.wide * build.width })),
    },
    0.028,
    (x, y, z) => {
      const ahead = dot(sub([x, y, z], toes), flat);
      return ahead > -0.05
        ? blendWeights(ankle, toe, smoothstep(-0.03, 0.02, ahead))
        : blendWeights(knee, ankle, smoothstep(0.035, -0.025, y - at[ankle]![1]));
    },
  );
  // The sole is flat, so that a foot stands on the floor.
  const rounded = shoe.field;
  return { ...shoe, field: (x, y, z) => -smoothUnion(-rounded(x, y, z), y - sole, SOLE_EDGE) };
}
