import { describe, expect, test } from 'vitest';
import { smoothHinges } from '../../../../web/motion/fit/twist';
import { dot, readVec, scale, type Vec3 } from '../../../../web/motion/math/vec3';

const down: Vec3 = [0, -1, 0];
/** Hinge axis of a limb that hangs down, turned by an angle. */
const axis = (angle: number): Vec3 => [Math.cos(angle), 0, Math.sin(angle)];
const angleOf = (hinge: Vec3): number => Math.atan2(hinge[2], hinge[0]);
const frames = (count: number): number[] => Array.from({ length: count }, (_, t) => t);

function smoothed(bones: readonly Vec3[], hinges: readonly Vec3[], priors: readonly Vec3[]): Vec3[] {
  const rows = (vectors: readonly Vec3[]): Float64Array => Float64Array.from(vectors.flat());
  const axes = smoothHinges(rows(bones), rows(hinges), rows(priors));
  return bones.map((_, t) => readVec(axes, t));
}

describe('hinges over time', () => {
  test('are those of a bent limb, at most a frame late', () => {
    const angles = frames(50).map((t) => Math.sin(t / 8));
    const hinges = smoothed(
      angles.map(() => down),
      angles.map((angle) => scale(axis(angle), 0.8)),
      angles.map(() => axis(0)),
    );
    hinges.forEach((hinge, t) => expect(Math.abs(angleOf(hinge) - angles[t]!)).toBeLessThan(1 / 8));
  });

  test('do not spin within a frame where a limb is hardly bent', () => {
    // From one side of a nearly straight limb to the other.
    const hinges = smoothed(
      frames(40).map(() => down),
      frames(40).map((t) => scale(axis(t < 20 ? 0 : 3), Math.sin(0.26))),
      frames(40).map(() => axis(0)),
    );
    for (let t = 1; t < 40; t++) {
      const turn = Math.acos(Math.min(1, dot(hinges[t]!, hinges[t - 1]!)));
      expect(turn).toBeLessThan(Math.PI / 4);
    }
  });

  test('are interpolated linearly while the limb is straight', () => {
    const bent = (t: number): boolean => t < 20 || t >= 60;
    const hinges = smoothed(
      frames(80).map(() => down),
      frames(80).map((t) => scale(axis(t < 20 ? 0.2 : 2.2), bent(t) ? 1 : 1e-9)),
      frames(80).map(() => axis(0)),
    );
    for (let t = 21; t < 60; t++) {
      const step = angleOf(hinges[t]!) - angleOf(hinges[t - 1]!);
      expect(step).toBeGreaterThan(0.01);
      expect(step).toBeLessThan(0.1);
    }
    expect(angleOf(hinges[5]!)).toBeCloseTo(0.2, 2);
    expect(angleOf(hinges[75]!)).toBeCloseTo(2.2, 2);
  });

  test('take the shorter way round', () => {
    const hinges = smoothed(
      frames(40).map(() => down),
      frames(40).map((t) => axis(t < 20 ? 3 : -3)),
      frames(40).map(() => axis(0)),
    );
    // From 3 to -3 over pi, never through 0.
    for (const hinge of hinges) expect(hinge[0]).toBeLessThan(-0.9);
  });

  test('are those of the prior for a limb that is never bent', () => {
    const hinges = smoothed(
      frames(30).map(() => down),
      frames(30).map(() => [0, 0, 0]),
      frames(30).map(() => axis(1)),
    );
    for (const hinge of hinges) expect(angleOf(hinge)).toBeCloseTo(1, 6);
  });

  test('come back to those of the prior where a limb stays straight for long', () => {
    const hinges = smoothed(
      frames(1500).map(() => down),
      frames(1500).map((t) => (t < 20 ? axis(0.3) : [0, 0, 0])),
      frames(1500).map((t) => axis(t < 20 ? 0 : 0.6)),
    );
    expect(angleOf(hinges[10]!)).toBeCloseTo(0.3, 2);
    expect(angleOf(hinges.at(-1)!)).toBeCloseTo(0.6, 3);
  });

  test('do not flip where the bone passes through the axis of the prior', () => {
    // The bone turns about z, the hinge is z; it shows at the beginning and at the end only.
    const angles = frames(60).map((t) => 0.4 + (t / 60) * 2.2);
    const hinges = smoothed(
      angles.map((angle): Vec3 => [Math.sin(angle), -Math.cos(angle), 0]),
      angles.map((_, t) => (t < 8 || t >= 52 ? [0, 0, 1] : [0, 0, 0])),
      angles.map((): Vec3 => [1, 0, 0]),
    );
    for (const hinge of hinges) expect(hinge[2]).toBeGreaterThan(0.98);
  });

  test('stay perpendicular to a bone in every direction', () => {
    const bones = frames(200).map((t): Vec3 => {
      const [a, b] = [t / 9, t / 7];
      return [Math.cos(a) * Math.sin(b), Math.cos(b), Math.sin(a) * Math.sin(b)];
    });
    const hinges = smoothed(
      bones,
      bones.map((): Vec3 => [0, 0, 0]),
      bones.map(() => axis(0)),
    );
    hinges.forEach((hinge, t) => {
      expect(Math.abs(dot(hinge, bones[t]!))).toBeLessThan(1e-9);
      expect(Math.hypot(...hinge)).toBeCloseTo(1, 9);
    });
  });
});
