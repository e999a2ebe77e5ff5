import { aboutAxis, IDENTITY, type Quat } from '../math/quat';
import { percentile } from '../math/statistics';
import { dot, length, type Vec3, X_AXIS, Z_AXIS } from '../math/vec3';

const QUARTER = Math.PI / 2;

/** Axes of a file and the turn that makes each point up; never a mirror. */
const UPS: readonly { readonly name: string; readonly axis: Vec3; readonly turn: Quat }[] = [
  { name: 'y', axis: [0, 1, 0], turn: IDENTITY },
  { name: 'z', axis: [0, 0, 1], turn: aboutAxis(X_AXIS, -QUARTER) },
  { name: '-z', axis: [0, 0, -1], turn: aboutAxis(X_AXIS, QUARTER) },
  { name: '-y', axis: [0, -1, 0], turn: aboutAxis(X_AXIS, 2 * QUARTER) },
  { name: 'x', axis: [1, 0, 0], turn: aboutAxis(Z_AXIS, QUARTER) },
  { name: '-x', axis: [-1, 0, 0], turn: aboutAxis(Z_AXIS, -QUARTER) },
];

/** Below this share of the vector's length along its main axis, up is a guess. */
const CLEAR = 0.8;

/**
 * The axis that points up, and the turn that makes it y.
 *
 * @param upright mean vector from the feet to the head over the clip
 * @returns `clear` is false where the body is so oblique that up is a guess
 */
export function findUp(upright: Vec3): { name: string; turn: Quat; clear: boolean } {
  const best = UPS.reduce((a, b) => (dot(b.axis, upright) > dot(a.axis, upright) ? b : a));
  return { name: best.name, turn: best.turn, clear: dot(best.axis, upright) >= CLEAR * length(upright) };
}

const UNITS = [
  { name: 'metres', metres: 1 },
  { name: 'centimetres', metres: 0.01 },
  { name: 'inches', metres: 0.0254 },
  { name: 'millimetres', metres: 0.001 },
  // The unit of the CMU library's own skeletons: 1 / 0.45 inch.
  { name: 'CMU units of 5.64 cm', metres: 0.0254 / 0.45 },
];

/** Leg plus trunk plus neck in metres: of a grown person, and the middle and ends of the range of all dancers. */
const GROWN = 1.45;
const MIDDLE = 1.18;
const SMALLEST = 0.7;
const LARGEST = 2;

/**
 * The unit in which a body is nearest to the middle of all persons' sizes.
 *
 * @param size leg plus trunk plus neck in the file's unit
 * @returns metres per unit; `known` is false where no unit fits and the body was brought to a person's size
 */
export function findUnit(size: number): { name: string; metres: number; known: boolean } {
  const away = (metres: number): number => Math.abs(Math.log((size * metres) / MIDDLE));
  const best = UNITS.reduce((a, b) => (away(b.metres) < away(a.metres) ? b : a));
  const person = size * best.metres;
  if (person >= SMALLEST && person <= LARGEST) return { ...best, known: true };
  return { name: 'unknown unit', metres: GROWN / size, known: false };
}

/** How the floor is found; a model whose training data stood on another floor is refused (model/manifest.ts). */
export const FLOOR = {
  /** Height of the toe joint (ball of the foot) of a planted foot, metres. */
  toe_rest: 0.03,
  /** Share of frames whose lower toe may lie below a planted one, in percent: noise and glitches. */
  percentile: 10,
} as const;

/**
 * Height of the floor under a dancer in metres, from the lower toe of every frame: in almost every frame of a dance
 * one foot stands.
 */
export function floorHeight(lowerToes: ArrayLike<number>): number {
  return percentile(lowerToes, FLOOR.percentile) - FLOOR.toe_rest;
}
