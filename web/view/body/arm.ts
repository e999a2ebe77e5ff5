import { J } from '../../motion/skeleton/skeleton';
import { add, smoothstep, scale, sub, unit, type Vec3 } from './field';
import {
  hingeShare,
  limbPart,
  blendWeights,
  scaledBy,
  alongBone,
  halfBuildScale,
  scaledToBuild,
  type Part,
  type BodyPlan,
  type Side,
  type Weights,
} from './part';

/** Centre of the shoulder: lower and further in than the motion capture joint, which lies on top of it. */
export function shoulderCentre(at: BodyPlan['at'], side: Side): Vec3 {
  const shoulder = at[side > 0 ? J.left_shoulder : J.right_shoulder]!;
  return add(shoulder, [-side * 0.016, -0.03, 0]);
}

export function upperArm({ at, build }: BodyPlan, side: Side): Part {
  const [collar, shoulder, elbow] =
    side > 0
      ? [J.left_collar, J.left_shoulder, J.left_elbow]
      : [J.right_collar, J.right_shoulder, J.right_elbow];
  const [from, to] = [shoulderCentre(at, side), at[elbow]!];
  const { span, down } = alongBone(from, to);
  return limbPart(
    {
      from,
      to,
      across: [0, 0, 1],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.047 },
        { at: 0.2, wide: 0.0485 },
        { at: 0.5, wide: 0.042 },
        { at: 0.8, wide: 0.036 },
        { at: 1, wide: 0.035 },
      ]),
    },
    { max: 0.06, at: (x, y, z) => 0.06 + (0.002 - 0.06) * smoothstep(0.02, 0.1, down(x, y, z)) },
    (x, y, z) => {
      const u = down(x, y, z);
      return u < span / 2
        ? blendWeights(collar, shoulder, smoothstep(-0.065, 0.075, u))
        : blendWeights(shoulder, elbow, hingeShare(u - span, 0.05));
    },
  );
}

export function forearm({ at, build }: BodyPlan, side: Side): Part {
  const [shoulder, elbow, wrist] =
    side > 0
      ? [J.left_shoulder, J.left_elbow, J.left_wrist]
      : [J.right_shoulder, J.right_elbow, J.right_wrist];
  const [from, to] = [at[elbow]!, at[wrist]!];
  const { span, down } = alongBone(from, to);
  return limbPart(
    {
      from,
      to,
      across: [0, 0, 1],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.0355 },
        { at: 0.22, wide: 0.041 },
        { at: 0.7, wide: 0.0315 },
        { at: 1, wide: 0.0275, deep: 0.0235 },
      ]),
    },
    0.018,
    (x, y, z) => {
      const u = down(x, y, z);
      return u < span / 2
        ? blendWeights(shoulder, elbow, hingeShare(u, 0.05))
        : blendWeights(elbow, wrist, smoothstep(-0.05, 0.03, u - span));
    },
  );
}

/** Palm with fingers as one solid, and a thumb: palm down in the rest pose, thumb forward. */
export function hand({ at, build }: BodyPlan, side: Side): Part[] {
  const [elbow, wrist] = side > 0 ? [J.left_elbow, J.left_wrist] : [J.right_elbow, J.right_wrist];
  const origin = at[wrist]!;
  const along = unit(sub(origin, at[elbow]!));
  const { span, down } = alongBone(at[elbow]!, origin);
  const forward: Vec3 = [0, 0, 1];
  const back: Vec3 = unit([-along[1] * side, along[0] * side, 0]);
  const here = (u: number, thumbwards: number, up: number): Vec3 =>
    add(add(origin, scale(along, u)), add(scale(forward, thumbwards), scale(back, up)));
  const weights = (x: number, y: number, z: number): Weights =>
    blendWeights(elbow, wrist, smoothstep(-0.05, 0.03, down(x, y, z) - span));
  const scaling = halfBuildScale(build);
  return [
    limbPart(
      {
        from: here(0.0, 0, 0),
        to: here(0.15, -0.002, -0.022),
        across: forward,
        stations: scaledBy(scaling, [
          { at: 0, wide: 0.028, deep: 0.0215 },
          { at: 0.38, wide: 0.0385, deep: 0.0205 },
          { at: 0.7, wide: 0.0335, deep: 0.0175 },
          { at: 1, wide: 0.0205, deep: 0.0145 },
        ]),
      },
      0.018,
      weights,
    ),
    limbPart(
      {
        from: here(0.03, 0.022, -0.004),
        to: here(0.086, 0.056, -0.016),
        across: forward,
        stations: scaledBy(scaling, [
          { at: 0, wide: 0.019 },
          { at: 1, wide: 0.0145 },
        ]),
      },
      0.014,
      weights,
    ),
  ];
}
