import { AppError } from '../../../common/error';
import { aboutAxis, multiply, type Quat } from '../../math/quat';
import { type Vec3, X_AXIS, Y_AXIS, Z_AXIS, ZERO } from '../../math/vec3';

/** Largest number of bones. */
const MAX_BONES = 500;
/** Metres in an inch: a unit of an ASF is an inch over the `length` that the file states. */
const INCH = 0.0254;

/** A bone of an ASF skeleton: its joint is where it begins. */
export interface Bone {
  readonly name: string;
  /** Index of the bone it hangs on; -1 for the root. */
  readonly parent: number;
  /** From where the bone begins to where it ends, in the file's unit. */
  readonly vector: Vec3;
  /** Rotation of the bone's own axes in the rest pose. */
  readonly axes: Quat;
  /** Channels in the order of the AMC: rx, ry, rz, and for the root TX, TY, TZ. */
  readonly channels: readonly string[];
}

export interface Asf {
  readonly bones: readonly Bone[];
  /** Metres in a unit. */
  readonly metres: number;
  /** Factor from the file's angles to radians. */
  readonly radians: number;
}

/** The error of a file that is not as ASF and AMC say. */
export function damagedAsf(what: string): AppError {
  return new AppError(
    'unreadable-file',
    `The ASF skeleton or the AMC motion is damaged: ${what}.`,
    'Download or copy both files again; they come in pairs.',
  );
}

const AXES: Readonly<Record<string, Vec3>> = { x: X_AXIS, y: Y_AXIS, z: Z_AXIS };

/** Rotations about the axes of an order such as XYZ, the first one first. */
export function inOrder(order: string, angles: readonly number[]): Quat {
  return [...order.toLowerCase()].reduce<Quat>(
    (turn, axis, i) => multiply(aboutAxis(AXES[axis] ?? X_AXIS, angles[i] ?? 0), turn),
    [0, 0, 0, 1],
  );
}

/** The words of a section after its keyword, up to the next one. */
function sectionOf(text: string, keyword: string): string {
  const start = text.search(new RegExp(`^:${keyword}\\b`, 'im'));
  if (start < 0) return '';
  const rest = text.slice(start + 1);
  const end = rest.search(/^:/m);
  return end < 0 ? rest : rest.slice(0, end);
}

/** The words after a key, on its line. */
function wordsOf(block: string, key: string): string[] {
  return new RegExp(`^\\s*${key}\\s+(.*)$`, 'im').exec(block)?.[1]?.trim().split(/\s+/) ?? [];
}

function numbersOf(block: string, key: string, count: number): number[] {
  const values = wordsOf(block, key).slice(0, count).map(Number);
  if (values.length < count || !values.every((value) => Math.abs(value) < 1e7))
    throw damagedAsf(`"${key}" of a bone is not ${count} numbers`);
  return values;
}

/**
 * Reads an ASF skeleton.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readAsf(text: string): Asf {
  const units = sectionOf(text, 'units');
  const length = Number(wordsOf(units, 'length')[0] ?? 1);
  const radians = /deg/i.test(wordsOf(units, 'angle')[0] ?? 'deg') ? Math.PI / 180 : 1;
  const metres = length > 0 ? INCH / length : INCH;
  const root = sectionOf(text, 'root');
  const blocks = sectionOf(text, 'bonedata').match(/\bbegin\b[\s\S]*?\bend\b/gi) ?? [];
  if (blocks.length === 0 || blocks.length > MAX_BONES) throw damagedAsf(`it has ${blocks.length} bones`);
  const found = new Map<string, Omit<Bone, 'parent'>>();
  found.set('root', {
    name: 'root',
    vector: ZERO,
    axes: inOrder(
      wordsOf(root, 'axis')[0] ?? 'XYZ',
      wordsOf(root, 'orientation').map((angle) => Number(angle) * radians),
    ),
    channels: wordsOf(root, 'order').map((one) => one.toLowerCase()),
  });
  for (const block of blocks) {
    const name = wordsOf(block, 'name')[0];
    if (name === undefined) throw damagedAsf('a bone has no name');
    const direction = numbersOf(block, 'direction', 3) as unknown as Vec3;
    const [size] = numbersOf(block, 'length', 1) as [number];
    const [, , , order = 'XYZ'] = wordsOf(block, 'axis');
    found.set(name, {
      name,
      vector: [direction[0] * size, direction[1] * size, direction[2] * size],
      axes: inOrder(
        order,
        numbersOf(block, 'axis', 3).map((angle) => angle * radians),
      ),
      channels: wordsOf(block, 'dof').map((one) => one.toLowerCase()),
    });
  }
  return { bones: ordered(found, sectionOf(text, 'hierarchy')), metres, radians };
}

/** The bones below the root by the lines of the hierarchy, parents first: `root lhipjoint rhipjoint lowerback`. */
function ordered(found: ReadonlyMap<string, Omit<Bone, 'parent'>>, hierarchy: string): Bone[] {
  const places = new Map([['root', 0]]);
  const bones: Bone[] = [{ ...found.get('root')!, parent: -1 }];
  const lines = hierarchy.split(/\r\n|\r|\n/).map((line) => line.trim().split(/\s+/));
  // Lines come in the order of the tree in nearly all files; passes over them find the others.
  for (let before = -1; bones.length > before;) {
    before = bones.length;
    for (const [parent = '', ...children] of lines)
      for (const child of children) {
        const [at, bone] = [places.get(parent), found.get(child)];
        if (at === undefined || !bone || places.has(child)) continue;
        places.set(child, bones.push({ ...bone, parent: at }) - 1);
      }
  }
  if (bones.length < 2) throw damagedAsf('its hierarchy names no bones');
  return bones;
}
