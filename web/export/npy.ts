/** An array of a .npy file, row-major. */
type NpyArray =
  | { readonly shape: readonly number[]; readonly data: Float32Array | Float64Array }
  | { readonly shape: readonly number[]; readonly data: readonly string[] };

/** Length of magic string, version and header length, bytes. */
const PREFIX_BYTES = 10;
/** NumPy aligns the data to this many bytes. */
const ALIGNMENT_BYTES = 64;

/**
 * Writes one .npy file, little-endian, version 1.0. Text becomes NumPy's fixed-width Unicode (`<U`), which is read
 * without pickle.
 */
export function npyBytes({ shape, data }: NpyArray): Uint8Array<ArrayBuffer> {
  const { type, content } = encoded(data);
  const sizes = shape.length === 1 ? `${shape[0]},` : shape.join(', ');
  const header = `{'descr': '${type}', 'fortran_order': False, 'shape': (${sizes}), }`;
  const start = Math.ceil((PREFIX_BYTES + header.length + 1) / ALIGNMENT_BYTES) * ALIGNMENT_BYTES;
  const out = new Uint8Array(start + content.byteLength);
  out.set([0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0]);
  new DataView(out.buffer).setUint16(8, start - PREFIX_BYTES, true);
  out.set(new TextEncoder().encode(header.padEnd(start - PREFIX_BYTES - 1) + '\n'), PREFIX_BYTES);
  out.set(content, start);
  return out;
}

function encoded(data: NpyArray['data']): { type: string; content: Uint8Array } {
  if (data instanceof Float32Array) return { type: '<f4', content: littleEndian(data) };
  if (data instanceof Float64Array) return { type: '<f8', content: littleEndian(data) };
  const strings = data.map((text) => Array.from(text, (character) => character.codePointAt(0) ?? 0));
  const width = Math.max(1, ...strings.map(({ length }) => length));
  const content = new DataView(new ArrayBuffer(4 * width * data.length));
  strings.forEach((points, row) => {
    points.forEach((point, column) => {
      content.setUint32(4 * (row * width + column), point, true);
    });
  });
  return { type: `<U${width}`, content: new Uint8Array(content.buffer) };
}

/** Numbers as little-endian bytes on every machine. */
function littleEndian(data: Float32Array | Float64Array): Uint8Array {
  const size = data.BYTES_PER_ELEMENT;
  const out = new DataView(new ArrayBuffer(data.byteLength));
  data.forEach((value, i) => {
    if (size === 4) out.setFloat32(4 * i, value, true);
    else out.setFloat64(8 * i, value, true);
  });
  return new Uint8Array(out.buffer);
}
