import { J } from '../../motion/skeleton/skeleton';
import { add, ramp, scale, sub, unit, type Vec3 } from './field';
import {
  hinge,
  limbPart,
  pass,
  resized,
  ruler,
  slightly,
  widened,
  type Part,
  type Plan,
  type Side,
  type Weights,
} from './part';

/** The arm's ball sits lower and further in than the mocap joint, which lies on top of the shoulder. */
export function shoulderCentre(at: Plan['at'], side: Side): Vec3 {
  const shoulder = at[side > 0 ? J.left_shoulder : J.right_shoulder]!;
  return add(shoulder, [-side * 0.016, -0.03, 0]);
}

export function upperArm({ at, build }: Plan, side: Side): Part {
  const [collar, shoulder, elbow] =
    side > 0
      ? [J.left_collar, J.left_shoulder, J.left_elbow]
      : [J.right_collar, J.right_shoulder, J.right_elbow];
  const [from, to] = [shoulderCentre(at, side), at[elbow]!];
  const { span, down } = ruler(from, to);
  return limbPart(
    {
      from,
      to,
      across: [0, 0, 1],
      stations: widened(build, [
        { at: 0, wide: 0.047 },
        { at: 0.2, wide: 0.0485 },
        { at: 0.5, wide: 0.042 },
        { at: 0.8, wide: 0.036 },
        { at: 1, wide: 0.035 },
      ]),
    },
    { most: 0.06, at: (x, y, z) => 0.06 + (0.002 - 0.06) * ramp(0.02, 0.1, down(x, y, z)) },
    (x, y, z) => {
      const u = down(x, y, z);
      return u < span / 2
        ? pass(collar, shoulder, ramp(-0.065, 0.075, u))
        : pass(shoulder, elbow, hinge(u - span, 0.05));
    },
  );
}

export function forearm({ at, build }: Plan, side: Side): Part {
  const [shoulder, elbow, wrist] =
    side > 0
      ? [J.left_shoulder, J.left_elbow, J.left_wrist]
      : [J.right_shoulder, J.right_elbow, J.right_wrist];
  const [from, to] = [at[elbow]!, at[wrist]!];
  const { span, down } = ruler(from, to);
  return limbPart(
    {
      from,
      to,
      across: [0, 0, 1],
      stations: widened(build, [
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
        ? pass(shoulder, elbow, hinge(u, 0.05))
        : pass(elbow, wrist, ramp(-0.05, 0.03, u - span));
    },
  );
}

/** A mitten with a thumb: palm down in the rest pose, thumb forward. */
export function hand({ at, build }: Plan, side: Side): Part[] {
  const [elbow, wrist] = side > 0 ? [J.left_elbow, J.left_wrist] : [J.right_elbow, J.right_wrist];
  const origin = at[wrist]!;
  const along = unit(sub(origin, at[elbow]!));
  const { span, down } = ruler(at[elbow]!, origin);
  const forward: Vec3 = [0, 0, 1];
  const back: Vec3 = unit([-along[1] * side, along[0] * side, 0]);
  const here = (u: number, thumbwards: number, up: number): Vec3 =>
    add(add(origin, scale(along, u)), add(scale(forward, thumbwards), scale(back, up)));
  const held = (x: number, y: number, z: number): Weights =>
    pass(elbow, wrist, ramp(-0.05, 0.03, down(x, y, z) - span));
  const h = slightly(build);
  return [
    limbPart(
      {
        from: here(0.0, 0, 0),
        to: here(0.15, -0.002, -0.022),
        across: forward,
        stations: resized(h, [
          { at: 0, wide: 0.028, deep: 0.0215 },
          { at: 0.38, wide: 0.0385, deep: 0.0205 },
          { at: 0.7, wide: 0.0335, deep: 0.0175 },
          { at: 1, wide: 0.0205, deep: 0.0145 },
        ]),
      },
      0.018,
      held,
    ),
    limbPart(
      {
        from: here(0.03, 0.022, -0.004),
        to: here(0.086, 0.056, -0.016),
        across: forward,
        stations: resized(h, [
          { at: 0, wide: 0.019 },
          { at: 1, wide: 0.0145 },
        ]),
      },
      0.014,
      held,
    ),
  ];
}
