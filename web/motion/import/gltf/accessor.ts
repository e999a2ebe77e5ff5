import { damagedGltf, type GltfFile } from './container';

const COMPONENTS: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

interface ComponentType {
  readonly bytes: number;
  readonly read: (view: DataView, at: number) => number;
  /** The value that stands for 1 where integers are normalised. */
  readonly one: number;
}

const TYPES: Readonly<Record<number, ComponentType>> = {
  5120: { bytes: 1, read: (view, at) => view.getInt8(at), one: 127 },
  5121: { bytes: 1, read: (view, at) => view.getUint8(at), one: 255 },
  5122: { bytes: 2, read: (view, at) => view.getInt16(at, true), one: 32767 },
  5123: { bytes: 2, read: (view, at) => view.getUint16(at, true), one: 65535 },
  5125: { bytes: 4, read: (view, at) => view.getUint32(at, true), one: 1 },
  5126: { bytes: 4, read: (view, at) => view.getFloat32(at, true), one: 1 },
};

/** Largest number of zeros that accessors without bytes of their own have together: such a file can be small. */
const MAX_ZEROS = 1e7;

/** How many zeros were made for a file. */
const zerosMade = new WeakMap<GltfFile, number>();

/** @throws {AppError} `unreadable-file` where those of the file would fill the memory */
function zeros(file: GltfFile, count: number): Float32Array {
  const made = (zerosMade.get(file) ?? 0) + count;
  if (made > MAX_ZEROS) throw damagedGltf(`it has more than ${MAX_ZEROS / 1e6} million zeros without bytes`);
  zerosMade.set(file, made);
  return new Float32Array(count);
}

/** Where numbers lie in a buffer, and of what kind they are. */
interface Rows {
  readonly bufferView?: number | undefined;
  readonly byteOffset: number;
  readonly componentType: number;
  readonly normalized?: boolean;
  readonly count: number;
}

/** Numbers in a buffer, `width` a row; `index` is that of their accessor. */
function readRows({ json, buffers }: GltfFile, index: number, rows: Rows, width: number): Float32Array {
  const type = TYPES[rows.componentType];
  const view = json.bufferViews[rows.bufferView ?? -1];
  const buffer = buffers[view?.buffer ?? -1];
  if (!type || !view || !buffer)
    throw damagedGltf(`the values number ${index} are missing or of an unknown type`);
  const stride = view.byteStride ?? width * type.bytes;
  const start = view.byteOffset + rows.byteOffset;
  const end = start + (rows.count - 1) * stride + width * type.bytes;
  if (rows.count > 0 && !(end <= buffer.length)) throw damagedGltf('a buffer ends too early');
  const data = new DataView(buffer.buffer, buffer.byteOffset, buffer.byteLength);
  const [factor, least] = rows.normalized ? [1 / type.one, -1] : [1, -Infinity];
  const out = new Float32Array(rows.count * width);
  for (let row = 0; row < rows.count; row++)
    for (let column = 0; column < width; column++) {
      const value = type.read(data, start + row * stride + column * type.bytes) * factor;
      if (!Number.isFinite(value)) throw damagedGltf(`the values number ${index} are not all finite`);
      out[row * width + column] = Math.max(value, least);
    }
  return out;
}

/**
 * The values of an accessor, normalised integers as -1 to 1: those in its buffer, or zeros where it has none, some of them
 * replaced where it is sparse.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readAccessor(file: GltfFile, index: number): Float32Array {
  const accessor = file.json.accessors[index];
  const width = COMPONENTS[accessor?.type ?? ''];
  if (!accessor || !width) throw damagedGltf(`the values number ${index} are missing or of an unknown type`);
  const { bufferView, componentType, normalized, count, sparse } = accessor;
  const out = bufferView === undefined ? zeros(file, count * width) : readRows(file, index, accessor, width);
  if (!sparse) return out;
  const places = readRows(file, index, { ...sparse.indices, count: sparse.count }, 1);
  const inPlace = { ...sparse.values, componentType, normalized, count: sparse.count };
  const values = readRows(file, index, inPlace, width);
  places.forEach((place, row) => {
    if (place >= count) throw damagedGltf(`the values number ${index} have places beyond their end`);
    out.set(values.subarray(row * width, (row + 1) * width), place * width);
  });
  return out;
}
