import { SOLE } from '../../motion/skeleton/kinematics';
import { J } from '../../motion/skeleton/skeleton';
import { blendWeights, boneSegment, gradual, hinge, jointOf } from './bone-segment';
import { add, dot, length, scale, sub, type Vec3, smoothstep, X_AXIS } from '../../motion/math/vec3';
import { smoothUnion, unit } from './field';
import { ball, limbPart, type BodyPlan, type Part, type Side } from './part';

/** Width over which the edge of the sole is rounded, metres. */
const SOLE_EDGE = 0.012;

export function buttock({ at, build }: BodyPlan, side: Side): Part {
  const hip = jointOf(side, 'hip');
  return ball(
    add(at[hip]!, [-side * 0.008, 0.008, -0.036]),
    scale([0.074, 0.088, 0.08], build.width),
    0.07,
    () => blendWeights(J.pelvis, hip, 0.45),
  );
}

export function thigh({ at, build }: BodyPlan, side: Side): Part {
  const [hip, knee] = [jointOf(side, 'hip'), jointOf(side, 'knee')];
  return boneSegment(build, {
    joints: [J.pelvis, hip, knee],
    from: at[hip]!,
    to: at[knee]!,
    across: X_AXIS,
    stations: [
      { at: 0, wide: 0.075, deep: 0.09 },
      { at: 0.32, wide: 0.074, deep: 0.085 },
      { at: 0.78, wide: 0.056, deep: 0.061 },
      { at: 0.92, wide: 0.048, deep: 0.052 },
      { at: 1, wide: 0.044, deep: 0.047 },
    ],
    blend: { atStart: 0.07, beyond: 0.006, over: [0.05, 0.2] },
    shares: [gradual(-0.07, 0.1), hinge(0.06)],
  });
}

export function shin({ at, build }: BodyPlan, side: Side): Part {
  const [knee, ankle] = [jointOf(side, 'knee'), jointOf(side, 'ankle')];
  return boneSegment(build, {
    joints: [jointOf(side, 'hip'), knee, ankle],
    from: at[knee]!,
    to: at[ankle]!,
    across: X_AXIS,
    stations: [
      { at: 0, wide: 0.0425, deep: 0.0455 },
      { at: 0.12, wide: 0.046, deep: 0.05, shift: -0.005 },
      { at: 0.3, wide: 0.052, deep: 0.057, shift: -0.014 },
      { at: 0.75, wide: 0.034, deep: 0.035, shift: -0.006 },
      { at: 1, wide: 0.0305, deep: 0.0315 },
    ],
    blend: 0.022,
    shares: [hinge(0.06), gradual(-0.035, 0.025)],
  });
}

export function foot({ at, build }: BodyPlan, side: Side): Part {
  const [knee, ankle, toe] = [jointOf(side, 'knee'), jointOf(side, 'ankle'), jointOf(side, 'foot')];
  const toes = at[toe]!;
  const sole = toes[1] - SOLE;
  const flat = unit([toes[0] - at[ankle]![0], 0, toes[2] - at[ankle]![2]]);
  const heel: Vec3 = add([at[ankle]![0], sole + 0.036, at[ankle]![2]], scale(flat, -0.03));
  const tip: Vec3 = add([toes[0], sole + 0.022, toes[2]], scale(flat, 0.056));
  const across: Vec3 = [flat[2], 0, -flat[0]];
  const span = length(sub(tip, heel));
  const ballAt = dot(sub(toes, heel), unit(sub(tip, heel))) / span;
  const shoe = limbPart(
    {
      from: heel,
      to: tip,
      across,
      stations: [
        { at: 0, wide: 0.0325, deep: 0.037 },
        { at: ballAt * 0.55, wide: 0.0355, deep: 0.042, shift: -0.004 },
        { at: ballAt, wide: 0.0435, deep: 0.032 },
        { at: 1, wide: 0.03, deep: 0.022 },
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
