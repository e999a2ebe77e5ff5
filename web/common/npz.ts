import { unzipSync } from 'fflate';

/** One array of a NumPy archive; integers and doubles come as doubles. */
export interface NpzArray {
  readonly shape: readonly number[];
  readonly data: Float32Array | Float64Array;
}

/** An array whose header was read, and whose values are when they are asked for. */
export interface StoredArray {
  readonly shape: readonly number[];
  /** NumPy's name of the values' type: `<f4` for little-endian floats of four bytes. */
  readonly type: string;
  /**
   * @param options gaps: whether values may be missing, as not-a-number
   * @throws what `damaged` makes, where the values cannot be read
   */
  read(options?: { readonly gaps?: boolean }): NpzArray;
}

/** Makes the error of a damaged archive or array from a sentence. */
export type DamageError = (message: string, cause?: unknown) => Error;

/** One value at a place; `little` is whether its lowest byte comes first. */
type Reader = (view: DataView, at: number, little: boolean) => number;

/** A float of two bytes (IEEE 754). */
function half(bits: number): number {
  const [exponent, fraction] = [(bits >> 10) & 31, bits & 1023];
  const size =
    exponent === 0
      ? fraction * 2 ** -24
      : exponent === 31
        ? fraction > 0
          ? NaN
          : Infinity
        : (1 + fraction / 1024) * 2 ** (exponent - 15);
  return bits & 0x8000 ? -size : size;
}

/** By kind and number of bytes, as NumPy names them after the order of bytes. */
const READERS: Record<string, Reader> = {
  f2: (view, at, little) => half(view.getUint16(at, little)),
  f4: (view, at, little) => view.getFloat32(at, little),
  f8: (view, at, little) => view.getFloat64(at, little),
  i1: (view, at) => view.getInt8(at),
  u1: (view, at) => view.getUint8(at),
  i2: (view, at, little) => view.getInt16(at, little),
  u2: (view, at, little) => view.getUint16(at, little),
  i4: (view, at, little) => view.getInt32(at, little),
  u4: (view, at, little) => view.getUint32(at, little),
  i8: (view, at, little) => Number(view.getBigInt64(at, little)),
  u8: (view, at, little) => Number(view.getBigUint64(at, little)),
};

/** Columns first (Fortran) to rows first, as NumPy writes the result of a transposition. */
function rowsFirst<T extends NpzArray['data']>(data: T, shape: readonly number[]): T {
  const out = data.slice() as T;
  const index = shape.map(() => 0);
  for (let to = 0; to < out.length; to++) {
    let from = 0;
    for (let axis = shape.length - 1; axis >= 0; axis--)
      from = from * (shape[axis] ?? 1) + (index[axis] ?? 0);
    out[to] = data[from] ?? NaN;
    for (let axis = shape.length - 1; axis >= 0; axis--) {
      const next = (index[axis] ?? 0) + 1;
      index[axis] = next === shape[axis] ? 0 : next;
      if (index[axis] !== 0) break;
    }
  }
  return out;
}

const MAGIC = '\u0093NUMPY';

/** The lengths in a header's shape; null where one is no length. */
function readShape(header: string): number[] | null {
  const inside = /'shape': \(([^)]*)\)/.exec(header)?.[1];
  if (inside === undefined) return null;
  const parts = inside.split(',').map((part) => part.trim());
  const lengths = parts.filter((text) => text !== '');
  return lengths.every((text) => /^\d{1,9}$/.test(text)) ? lengths.map(Number) : null;
}

/**
 * Reads the header of one .npy file. Values that can be read are floats of 16 to 64 bits and whole numbers of 8 to 64 bits,
 * all finite.
 *
 * @param name the array's name in sentences
 * @throws what `damaged` makes, where the header cannot be read
 */
export function openNpy(bytes: Uint8Array, name: string, damaged: DamageError): StoredArray {
  const text = (from: number, to: number): string => String.fromCharCode(...bytes.subarray(from, to));
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = bytes.length > 12 && view.getUint8(6) > 1 ? 12 : 10;
  if (bytes.length <= start || text(0, MAGIC.length) !== MAGIC)
    throw damaged(`The array "${name}" is not a NumPy array.`);
  const end = start + (start === 12 ? view.getUint32(8, true) : view.getUint16(8, true));
  const header = new TextDecoder().decode(bytes.subarray(start, end));
  const shape = readShape(header);
  const wrongSize = () => damaged(`The array "${name}" does not have the size that its header states.`);
  if (!shape) throw wrongSize();
  const type = /'descr': '([^']+)'/.exec(header)?.[1] ?? '';
  const readValues = ({ gaps = false } = {}): NpzArray => {
    const [, order = '', kind = '', size = ''] = /^([<>|=])([fiu])(\d)$/.exec(type) ?? [];
    const read = READERS[`${kind}${size}`];
    if (read === undefined)
      throw damaged(`The array "${name}" is of a type that is not read here: ${type.slice(0, 24)}.`);
    const count = shape.reduce((product, length) => product * length, 1);
    if (bytes.length - end !== count * Number(size)) throw wrongSize();
    const values = new DataView(bytes.buffer, bytes.byteOffset + end);
    const data = kind === 'f' && Number(size) <= 4 ? new Float32Array(count) : new Float64Array(count);
    for (let i = 0; i < count; i++) data[i] = read(values, i * Number(size), order !== '>');
    if (!data.every((value) => Number.isFinite(value) || (gaps && Number.isNaN(value))))
      throw damaged(`The array "${name}" holds a value that is not a finite number.`);
    return { shape, data: header.includes("'fortran_order': True") ? rowsFirst(data, shape) : data };
  };
  return { shape, type, read: readValues };
}

/**
 * The .npy files in a NumPy archive (numpy.savez, compressed or not), by the names of their arrays. None is unpacked that
 * would make them larger than `maxBytes`.
 *
 * @throws what `damaged` makes
 */
export function unzipArrays(
  bytes: Uint8Array,
  maxBytes: number,
  damaged: DamageError,
): Map<string, Uint8Array> {
  let total = 0;
  let tooLarge = false;
  try {
    const files = unzipSync(bytes, {
      filter: ({ originalSize }) => {
        total += originalSize;
        tooLarge = total > maxBytes;
        if (tooLarge) throw new RangeError('too large');
        return true;
      },
    });
    return new Map(
      Object.entries(files).map(([file, content]) => [file.replace(/\.npy$/, ''), content] as const),
    );
  } catch (cause) {
    throw damaged(
      tooLarge
        ? `The archive holds more than ${maxBytes / 1024 ** 2} MB.`
        : 'The archive of arrays is damaged: it is not a whole zip file.',
      cause,
    );
  }
}
