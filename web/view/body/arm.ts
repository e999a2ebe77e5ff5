import { alongBone, blendWeights, boneSegment, gradual, hinge, jointOf } from './bone-segment';
import { add, scale, sub, type Vec3, smoothstep, Z_AXIS } from '../../motion/math/vec3';
import { unit } from './field';
import {
  halfBuildScale,
  limbPart,
  scaledBy,
  type BodyPlan,
  type Part,
  type Side,
  type Weights,
} from './part';

/** Centre of the shoulder: lower and further in than the motion capture joint, which lies on top of it. */
export function shoulderCentre(at: BodyPlan['at'], side: Side): Vec3 {
  return add(at[jointOf(side, 'shoulder')]!, [-side * 0.016, -0.03, 0]);
}

export function upperArm({ at, build }: BodyPlan, side: Side): Part {
  const [shoulder, elbow] = [jointOf(side, 'shoulder'), jointOf(side, 'elbow')];
  return boneSegment(build, {
    joints: [jointOf(side, 'collar'), shoulder, elbow],
    from: shoulderCentre(at, side),
    to: at[elbow]!,
    across: Z_AXIS,
    stations: [
      { at: 0, wide: 0.047 },
      { at: 0.2, wide: 0.0485 },
      { at: 0.5, wide: 0.042 },
      { at: 0.8, wide: 0.036 },
      { at: 1, wide: 0.0335 },
    ],
    blend: { atStart: 0.06, beyond: 0.002, over: [0.02, 0.1] },
    shares: [gradual(-0.065, 0.075), hinge(0.05)],
  });
}

export function forearm({ at, build }: BodyPlan, side: Side): Part {
  const [elbow, wrist] = [jointOf(side, 'elbow'), jointOf(side, 'wrist')];
  return boneSegment(build, {
    joints: [jointOf(side, 'shoulder'), elbow, wrist],
    from: at[elbow]!,
    to: at[wrist]!,
    across: Z_AXIS,
    stations: [
      { at: 0, wide: 0.034 },
      { at: 0.24, wide: 0.0405 },
      { at: 0.7, wide: 0.031 },
      { at: 1, wide: 0.0265, deep: 0.022 },
    ],
    blend: 0.018,
    shares: [hinge(0.05), gradual(-0.05, 0.03)],
  });
}

/** How far the palm of a hanging arm is turned backward, radians: its back and the thumb are seen from the front. */
const PALM_TURN = 0.5;

/** Palm with fingers as one solid, a little bent, and a thumb: palm down in the rest pose, thumb forward. */
export function hand({ at, build }: BodyPlan, side: Side): Part[] {
  const [elbow, wrist] = [jointOf(side, 'elbow'), jointOf(side, 'wrist')];
  const origin = at[wrist]!;
  const along = unit(sub(origin, at[elbow]!));
  const { span, down } = alongBone(at[elbow]!, origin);
  const outward: Vec3 = unit([-along[1] * side, along[0] * side, 0]);
  const [cos, sin] = [Math.cos(PALM_TURN), Math.sin(PALM_TURN)];
  const thumbSide = add(scale(Z_AXIS, cos), scale(outward, -sin));
  const back = add(scale(outward, cos), scale(Z_AXIS, sin));
  const here = (u: number, thumbwards: number, up: number): Vec3 =>
    add(add(origin, scale(along, u)), add(scale(thumbSide, thumbwards), scale(back, up)));
  const weights = (x: number, y: number, z: number): Weights =>
    blendWeights(elbow, wrist, smoothstep(-0.05, 0.03, down(x, y, z) - span));
  const scaling = halfBuildScale(build);
  return [
    limbPart(
      {
        from: here(0, 0, 0),
        to: here(0.162, -0.004, -0.03),
        // Mirrored, so that sections are shifted towards the back of the hand on both sides.
        across: scale(thumbSide, side),
        stations: scaledBy(scaling, [
          { at: 0, wide: 0.0265, deep: 0.0215 },
          { at: 0.32, wide: 0.0395, deep: 0.0215, shift: -0.004 },
          { at: 0.62, wide: 0.035, deep: 0.0185, shift: -0.006 },
          { at: 0.85, wide: 0.027, deep: 0.017, shift: -0.003 },
          { at: 1, wide: 0.0185, deep: 0.0155 },
        ]),
      },
      0.018,
      weights,
    ),
    limbPart(
      {
        from: here(0.032, 0.02, -0.006),
        to: here(0.092, 0.05, -0.022),
        across: thumbSide,
        stations: scaledBy(scaling, [
          { at: 0, wide: 0.0195 },
          { at: 1, wide: 0.0165 },
        ]),
      },
      0.014,
      weights,
    ),
  ];
}
