import { J } from '../../motion/skeleton/skeleton';
import { boneSegment, gradual } from './bone-segment';
import { add, scale, type Vec3, X_AXIS } from '../../motion/math/vec3';
import { ellipsoid, limb, smoothCut, smoothUnion } from './field';
import { ball, halfBuildScale, type BodyPlan, type Part } from './part';

/** Clearly narrower than the skull, and leaning forward a little. */
export function neck({ at, build }: BodyPlan): Part {
  const from = add(at[J.neck]!, [0, -0.03, -0.012]);
  const to = add(at[J.head]!, [0, 0.035, 0]);
  const half = (to[1] - from[1]) / 2;
  return boneSegment(build, {
    joints: [J.spine3, J.neck, J.head],
    from,
    to,
    across: X_AXIS,
    stations: [
      { at: 0, wide: 0.056 },
      { at: 0.5, wide: 0.0475 },
      { at: 1, wide: 0.046 },
    ],
    blend: 0.04,
    shares: [gradual(0, half), gradual(-half, 0.005)],
  });
}

/** Skull and jaw, eye sockets cut out as one, and a nose: enough to see where a dancer looks. One solid, so that only
 * its lower edge blends with the neck. */
export function head({ at, build }: BodyPlan): Part {
  const scaling = halfBuildScale(build);
  const here = (x: number, y: number, z: number): Vec3 => add(at[J.head]!, scale([x, y, z], scaling));
  const radii = (x: number, y: number, z: number): Vec3 => scale([x, y, z], scaling);
  const skull = ellipsoid(here(0, 0.105, 0.004), radii(0.0755, 0.088, 0.095));
  const jaw = ellipsoid(here(0, 0.04, 0.028), radii(0.05, 0.062, 0.056));
  const sockets = ellipsoid(here(0, 0.09, 0.13), radii(0.085, 0.014, 0.036));
  const nose = limb({
    from: here(0, 0.088, 0.082),
    to: here(0, 0.058, 0.083),
    across: X_AXIS,
    stations: [
      { at: 0, wide: 0.011 },
      { at: 1, wide: 0.0155 },
    ],
  });
  const whole = ball(here(0, 0.08, 0.015), radii(0.085, 0.125, 0.12), 0.022, () => [[J.head, 1]]);
  return {
    ...whole,
    field: (x, y, z) => {
      const skullAndJaw = smoothUnion(skull(x, y, z), jaw(x, y, z), 0.055);
      return smoothUnion(smoothCut(skullAndJaw, sockets(x, y, z), 0.03), nose(x, y, z), 0.025);
    },
  };
}
