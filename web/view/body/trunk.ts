import { J } from '../../motion/skeleton/skeleton';
import { add, smoothstep, scale, type Vec3 } from './field';
import { shoulderCentre } from './arm';
import {
  ball,
  movedBy,
  limbPart,
  blendWeights,
  alongBone,
  halfBuildScale,
  scaledToBuild,
  type Part,
  type BodyPlan,
  type Side,
} from './part';

/**
 * Hips to the base of the neck, one solid. Positive shifts are backward: hollow at the waist, broad between the
 * shoulder blades.
 */
export function torso({ at, build }: BodyPlan): Part {
  const hips = scale(add(at[J.left_hip]!, at[J.right_hip]!), 0.5);
  const from: Vec3 = [0, hips[1], hips[2] * 0.5];
  const to: Vec3 = add(at[J.neck]!, [0, -0.012, -0.012]);
  const waist = build.waist;
  const stations = scaledToBuild(build, [
    { at: 0, wide: 0.112, deep: 0.094 },
    { at: 0.12, wide: 0.137, deep: 0.099, shift: 0.002 },
    { at: 0.28, wide: 0.127 * (1 + waist) * 0.5, deep: 0.09 },
    { at: 0.43, wide: 0.121 * waist, deep: 0.083 * waist, shift: -0.008 },
    { at: 0.6, wide: 0.138, deep: 0.098, shift: -0.004 },
    { at: 0.76, wide: 0.154, deep: 0.107, shift: 0.004 },
    { at: 0.89, wide: 0.138, deep: 0.09, shift: 0.006 },
    { at: 1, wide: 0.08, deep: 0.064 },
  ]);
  const spine: [number, number][] = [
    [J.pelvis, at[J.pelvis]![1] + 0.02],
    [J.spine1, (at[J.spine1]![1] + at[J.spine2]![1]) / 2],
    [J.spine2, (at[J.spine2]![1] + at[J.spine3]![1]) / 2],
    [J.spine3, at[J.spine3]![1] + 0.06],
  ];
  return limbPart({ from, to, across: [1, 0, 0], stations, exponent: 2.3 }, 0, (_, y) => {
    for (let i = 0; i < spine.length - 1; i++) {
      const [joint, low] = spine[i]!;
      const [next, high] = spine[i + 1]!;
      if (y < high) return blendWeights(joint, next, smoothstep(low, high, y));
    }
    return [[J.spine3, 1]];
  });
}

/** From the neck to the top of the arm, where the collar bone and the muscle behind it lie. */
export function shoulderSlope({ at, build }: BodyPlan, side: Side): Part {
  const [collar, shoulder] = side > 0 ? [J.left_collar, J.left_shoulder] : [J.right_collar, J.right_shoulder];
  const from = add(at[J.neck]!, [side * 0.02, 0.012, -0.012]);
  const to = add(shoulderCentre(at, side), [-side * 0.03, -0.002, -0.004]);
  const { span, down } = alongBone(from, to);
  return limbPart(
    {
      from,
      to,
      across: [0, 0, 1],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.041 },
        { at: 1, wide: 0.043 },
      ]),
    },
    0.075,
    (x, y, z) => {
      const t = down(x, y, z) / span;
      return t < 0.62
        ? blendWeights(J.spine3, collar, smoothstep(0.05, 0.6, t))
        : blendWeights(collar, shoulder, 0.5 * smoothstep(0.62, 1.05, t));
    },
  );
}

export function neck({ at, build }: BodyPlan): Part {
  const from = add(at[J.neck]!, [0, -0.035, -0.01]);
  const to = add(at[J.head]!, [0, 0.02, -0.012]);
  const span = to[1] - from[1];
  return limbPart(
    {
      from,
      to,
      across: [1, 0, 0],
      stations: scaledToBuild(build, [
        { at: 0, wide: 0.062 },
        { at: 0.55, wide: 0.05 },
        { at: 1, wide: 0.048 },
      ]),
    },
    0.075,
    (_, y) => {
      const t = (y - from[1]) / span;
      return t < 0.5
        ? blendWeights(J.spine3, J.neck, smoothstep(0, 0.5, t))
        : blendWeights(J.neck, J.head, smoothstep(0.5, 1.05, t));
    },
  );
}

/** Skull, jaw, eye sockets cut out as one, and a nose: enough to see where a dancer looks. */
export function head({ at, build }: BodyPlan): Part[] {
  const origin = at[J.head]!;
  const here = (x: number, y: number, z: number): Vec3 => add(origin, [x, y, z]);
  const weights = movedBy(J.head);
  const scaling = halfBuildScale(build);
  const nose = { from: here(0, 0.092, 0.088), to: here(0, 0.056, 0.1), across: [1, 0, 0] as Vec3 };
  return [
    ball(here(0, 0.1, 0.006), scale([0.073, 0.086, 0.094], scaling), 0.05, weights),
    ball(here(0, 0.03, 0.034), scale([0.05, 0.062, 0.058], scaling), 0.06, weights),
    ball(here(0, 0.085, 0.132), [0.085, 0.016, 0.036], 0.03, weights, true),
    limbPart(
      {
        ...nose,
        stations: [
          { at: 0, wide: 0.011 },
          { at: 1, wide: 0.0135 },
        ],
      },
      0.026,
      weights,
    ),
  ];
}
