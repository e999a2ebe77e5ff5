import { aboutAxis, IDENTITY, type Quat } from '../math/quat';
import { percentile } from '../math/statistics';
import { dot, length, type Vec3, X_AXIS, Z_AXIS } from '../math/vec3';
import { SOLE } from '../skeleton/kinematics';

const QUARTER_TURN = Math.PI / 2;

export type AxisName = 'y' | 'z' | '-z' | '-y' | 'x' | '-x';

/** An up axis of a file, and the rotation that brings it to y. */
interface UpAxis {
  readonly name: AxisName;
  readonly axis: Vec3;
  readonly turn: Quat;
}

/** Possible up axes. None of the rotations mirrors. */
export const UP_AXES: readonly UpAxis[] = [
  { name: 'y', axis: [0, 1, 0], turn: IDENTITY },
  { name: 'z', axis: [0, 0, 1], turn: aboutAxis(X_AXIS, -QUARTER_TURN) },
  { name: '-z', axis: [0, 0, -1], turn: aboutAxis(X_AXIS, QUARTER_TURN) },
  { name: '-y', axis: [0, -1, 0], turn: aboutAxis(X_AXIS, 2 * QUARTER_TURN) },
  { name: 'x', axis: [1, 0, 0], turn: aboutAxis(Z_AXIS, QUARTER_TURN) },
  { name: '-x', axis: [-1, 0, 0], turn: aboutAxis(Z_AXIS, -QUARTER_TURN) },
];

/** Least share of the vector's length along the chosen axis with which up is certain. */
const CERTAIN_SHARE = 0.8;

/**
 * The axis that points up, and the turn that makes it y.
 *
 * @param upright mean vector from the feet to the head over the clip
 * @returns `certain` is false where the body is so oblique that up is a guess
 */
export function findUp(upright: Vec3): UpAxis & { certain: boolean } {
  const best = UP_AXES.reduce((a, b) => (dot(b.axis, upright) > dot(a.axis, upright) ? b : a));
  return { ...best, certain: dot(best.axis, upright) >= CERTAIN_SHARE * length(upright) };
}

export type UnitName =
  | 'metres'
  | 'decimetres'
  | 'centimetres'
  | 'inches'
  | 'millimetres'
  | 'feet'
  | 'MMD units of 8 cm'
  | 'CMU units of 5.64 cm';

export interface Unit<Name = string> {
  readonly name: Name;
  readonly metres: number;
}

/** Units in which bodies are found. */
const UNITS: readonly Unit<UnitName>[] = [
  { name: 'metres', metres: 1 },
  // The unit of MakeHuman.
  { name: 'decimetres', metres: 0.1 },
  { name: 'centimetres', metres: 0.01 },
  { name: 'inches', metres: 0.0254 },
  { name: 'millimetres', metres: 0.001 },
  // The unit of the CMU library's own skeletons: 1 / 0.45 inch.
  { name: 'CMU units of 5.64 cm', metres: 0.0254 / 0.45 },
];

/** Units that can be chosen: two of them are never inferred, as their bodies would look like those of others. */
export const ALL_UNITS: readonly Unit<UnitName>[] = [
  ...UNITS,
  { name: 'feet', metres: 0.3048 },
  { name: 'MMD units of 8 cm', metres: 0.08 },
];

/** Words of files for units. */
const UNIT_WORDS: Readonly<Record<string, UnitName>> = {
  m: 'metres',
  meters: 'metres',
  cm: 'centimetres',
  centimeters: 'centimetres',
  mm: 'millimetres',
  millimeters: 'millimetres',
};

/** The unit that a file states with a word such as `mm` or `Millimeters`; null for other words. */
export function unitOfWord(word: string): Unit | null {
  const name = UNIT_WORDS[word.toLowerCase()];
  return ALL_UNITS.find((unit) => unit.name === name) ?? null;
}

/** Leg plus trunk plus neck of an adult, and the middle and the ends of the accepted range, metres. */
const ADULT_SIZE = 1.45;
const MIDDLE_SIZE = 1.18;
const MIN_SIZE = 0.7;
const MAX_SIZE = 2;

/** The same range for files that this page wrote: its dancers are 0.5 to 2.5 m high. */
const OWN_MIN_SIZE = 0.2;
const OWN_MAX_SIZE = 2.6;

/** Whether a body has the size of a person. @param size leg plus trunk plus neck, metres */
export function isOfPerson(size: number): boolean {
  return size >= MIN_SIZE && size <= MAX_SIZE;
}

/** The unit of BVH files that this page wrote, which state none. */
const CENTIMETRES: Unit = { name: 'centimetres', metres: 0.01 };

/** The unit of a file that this page wrote; null where no dancer here has the body's size. Arguments as of `findUnit`. */
export function ownUnit(size: number, stated: Unit | null): Unit | null {
  const unit = stated ?? CENTIMETRES;
  return size * unit.metres >= OWN_MIN_SIZE && size * unit.metres <= OWN_MAX_SIZE ? unit : null;
}

/**
 * The unit in which a body's size is nearest to the middle of the range, by ratio.
 *
 * @param size leg plus trunk plus neck in the file's unit
 * @param stated the unit that the file or its format states; taken where it gives the body a possible size
 * @returns metres per unit; `known` is false where no unit fits and the body is scaled to an adult
 */
export function findUnit(size: number, stated: Unit | null): Unit & { known: boolean } {
  const fits = (metres: number): boolean => isOfPerson(size * metres);
  if (stated && fits(stated.metres)) return { ...stated, known: true };
  const deviation = (metres: number): number => Math.abs(Math.log((size * metres) / MIDDLE_SIZE));
  const best = UNITS.reduce((a, b) => (deviation(b.metres) < deviation(a.metres) ? b : a));
  if (fits(best.metres)) return { ...best, known: true };
  return { name: 'unknown unit', metres: ADULT_SIZE / size, known: false };
}

/** How the floor is found; a model whose training data stood on another floor is refused (model/manifest.ts). */
export const FLOOR = {
  /** Height of the toe joint (ball of the foot) of a standing foot, metres. */
  toe_rest: SOLE,
  /** Share of frames whose lower toe may lie below that of a standing foot, in percent: noise and glitches. */
  percentile: 10,
} as const;

/**
 * Height of the floor under a dancer in metres, from the lower toe of every frame: in almost every frame of a dance
 * one foot stands.
 */
export function floorHeight(lowerToes: ArrayLike<number>): number {
  return percentile(lowerToes, FLOOR.percentile) - FLOOR.toe_rest;
}
