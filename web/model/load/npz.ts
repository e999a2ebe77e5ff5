import { unzipSync } from 'fflate';

/** One array of a NumPy archive; integers and doubles come as doubles. */
export interface NpzArray {
  readonly shape: readonly number[];
  readonly data: Float32Array | Float64Array;
}

type Reader = (view: DataView, count: number) => Float32Array | Float64Array;

const READERS: Record<string, Reader> = {
  '<f4': (view, count) => Float32Array.from({ length: count }, (_, i) => view.getFloat32(4 * i, true)),
  '<f8': (view, count) => Float64Array.from({ length: count }, (_, i) => view.getFloat64(8 * i, true)),
  '<i4': (view, count) => Float64Array.from({ length: count }, (_, i) => view.getInt32(4 * i, true)),
  '<i8': (view, count) =>
    Float64Array.from({ length: count }, (_, i) => Number(view.getBigInt64(8 * i, true))),
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

/** Read one .npy file: little-endian float32, float64, int32 or int64. */
function readNpy(bytes: Uint8Array, name: string): NpzArray {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const wide = view.getUint8(6) > 1;
  const start = wide ? 12 : 10;
  const end = start + (wide ? view.getUint32(8, true) : view.getUint16(8, true));
  const header = new TextDecoder().decode(bytes.subarray(start, end));
  const type = /'descr': '([^']+)'/.exec(header)?.[1] ?? '';
  const shape = (/'shape': \(([^)]*)\)/.exec(header)?.[1] ?? '').split(',').flatMap((part) => {
    const text = part.trim();
    return text === '' ? [] : [Number(text)];
  });
  const read = READERS[type];
  if (read === undefined) throw new Error(`The array "${name}" is of a type that is not read here: ${type}`);
  const count = shape.reduce((product, length) => product * length, 1);
  const data = read(new DataView(bytes.buffer, bytes.byteOffset + end), count);
  return { shape, data: header.includes("'fortran_order': True") ? rowsFirst(data, shape) : data };
}

/** Read a NumPy archive (numpy.savez, compressed or not). */
export function readNpz(bytes: Uint8Array): Map<string, NpzArray> {
  return new Map(
    Object.entries(unzipSync(bytes)).map(([file, content]) => {
      const name = file.replace(/\.npy$/, '');
      return [name, readNpy(content, name)];
    }),
  );
}
