import { zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { readNpz } from '../../../../web/model/load/npz';

/** One .npy file as NumPy 1.0 writes it. */
function npy(descr: string, shape: string, data: ArrayBufferView, fortran = false): Uint8Array {
  const dict = `{'descr': '${descr}', 'fortran_order': ${fortran ? 'True' : 'False'}, 'shape': ${shape}, }`;
  const header = new TextEncoder().encode(dict.padEnd(117) + '\n');
  const out = new Uint8Array(10 + header.length + data.byteLength);
  out.set([0x93, ...new TextEncoder().encode('NUMPY'), 1, 0, header.length, 0]);
  out.set(header, 10);
  out.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), 10 + header.length);
  return out;
}

describe('readNpz', () => {
  it('reads floats and integers of every shape', () => {
    const arrays = readNpz(
      zipSync({
        'scalar.npy': npy('<f8', '()', new Float64Array([0.1])),
        'row.npy': npy('<i8', '(3,)', new BigInt64Array([1n, -2n, 3n])),
        'table.npy': npy('<f4', '(2, 3)', new Float32Array([1, 2, 3, 4, 5, 6])),
        'none.npy': npy('<f4', '(0, 3)', new Float32Array()),
      }),
    );
    expect(arrays.get('scalar')).toEqual({ shape: [], data: new Float64Array([0.1]) });
    expect(arrays.get('row')).toEqual({ shape: [3], data: new Float64Array([1, -2, 3]) });
    expect(arrays.get('table')).toEqual({ shape: [2, 3], data: new Float32Array([1, 2, 3, 4, 5, 6]) });
    expect(arrays.get('none')).toEqual({ shape: [0, 3], data: new Float32Array() });
  });

  it('reads arrays in Fortran order', () => {
    // a[i, j, k] = 100 i + 10 j + k, first axis fastest.
    const stored = [0, 1].flatMap((k) => [0, 1, 2].flatMap((j) => [0, 1].map((i) => 100 * i + 10 * j + k)));
    const arrays = readNpz(zipSync({ 'a.npy': npy('<f4', '(2, 3, 2)', new Float32Array(stored), true) }));
    expect(arrays.get('a')?.data).toEqual(
      new Float32Array([0, 1, 10, 11, 20, 21, 100, 101, 110, 111, 120, 121]),
    );
  });

  it('names an array of a type that it cannot read', () => {
    const archive = zipSync({ 'words.npy': npy('<U4', '(1,)', new Uint8Array(16)) });
    expect(() => readNpz(archive)).toThrow('"words" is of a type that is not read here: <U4');
  });
});
