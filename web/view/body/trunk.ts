import { J } from '../../motion/skeleton/skeleton';
import { shoulderCentre } from './arm';
import { blendWeights, boneSegment, gradual, jointOf } from './bone-segment';
import { add, length, scale, sub, type Vec3, smoothstep, X_AXIS, Z_AXIS } from '../../motion/math/vec3';
import { limbPart, scaledToBuild, type BodyPlan, type Part, type Side } from './part';

/**
 * Hips to the base of the neck, one solid. Positive shifts are backward: hollow at the waist, broad between the
 * shoulder blades.
 */
export function torso({ at, build }: BodyPlan): Part {
  const hips = scale(add(at[J.left_hip]!, at[J.right_hip]!), 0.5);
  const from: Vec3 = [0, hips[1], hips[2] * 0.5];
  const to: Vec3 = add(at[J.neck]!, [0, -0.042, -0.012]);
  const waist = build.waist;
  const stations = scaledToBuild(build, [
    { at: 0, wide: 0.108, deep: 0.092 },
    { at: 0.13, wide: 0.129, deep: 0.097, shift: 0.002 },
    { at: 0.31, wide: 0.124 * (1 + waist) * 0.5, deep: 0.09 },
    { at: 0.47, wide: 0.124 * waist, deep: 0.085 * waist, shift: -0.006 },
    { at: 0.66, wide: 0.14, deep: 0.098, shift: -0.004 },
    { at: 0.82, wide: 0.153, deep: 0.104, shift: 0.004 },
    { at: 0.92, wide: 0.142, deep: 0.088, shift: 0.006 },
    { at: 1, wide: 0.108, deep: 0.07, shift: 0.004 },
  ]);
  const spine: [number, number][] = [
    [J.pelvis, at[J.pelvis]![1] + 0.02],
    [J.spine1, (at[J.spine1]![1] + at[J.spine2]![1]) / 2],
    [J.spine2, (at[J.spine2]![1] + at[J.spine3]![1]) / 2],
    [J.spine3, at[J.spine3]![1] + 0.06],
  ];
  return limbPart({ from, to, across: X_AXIS, stations, exponent: 2.3 }, 0, (_, y) => {
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
  const from = add(at[J.neck]!, [side * 0.022, -0.016, -0.024]);
  const to = add(shoulderCentre(at, side), [-side * 0.03, -0.004, -0.012]);
  const span = length(sub(to, from));
  return boneSegment(build, {
    joints: [J.spine3, jointOf(side, 'collar'), jointOf(side, 'shoulder')],
    from,
    to,
    across: Z_AXIS,
    stations: [
      { at: 0, wide: 0.056, deep: 0.037 },
      { at: 1, wide: 0.057, deep: 0.042 },
    ],
    blend: 0.085,
    shares: [gradual(0.03 * span, 0.52 * span), (past) => 0.5 * smoothstep(-0.4 * span, 0.05 * span, past)],
  });
}
