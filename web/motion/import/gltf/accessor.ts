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

/** An accessor and what it refers to. */
function accessorAt({ json, buffers }: GltfFile, index: number) {
  const accessor = json.accessors[index];
  const type = accessor && TYPES[accessor.componentType];
  const width = accessor && COMPONENTS[accessor.type];
  const view = accessor?.bufferView === undefined ? undefined : json.bufferViews[accessor.bufferView];
  const buffer = view && buffers[view.buffer];
  if (!accessor || !type || !width || !view || !buffer)
    throw damagedGltf(`the values number ${index} are missing or of an unknown type`);
  if (accessor.sparse !== undefined) throw damagedGltf(`the values number ${index} are sparse`);
  return { accessor, type, width, view, buffer };
}

/**
 * The values of an accessor, normalised integers as -1 to 1.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readAccessor(file: GltfFile, index: number): Float32Array {
  const { accessor, type, width, view, buffer } = accessorAt(file, index);
  const stride = view.byteStride ?? width * type.bytes;
  const start = view.byteOffset + accessor.byteOffset;
  const end = start + (accessor.count - 1) * stride + width * type.bytes;
  if (accessor.count > 0 && !(end <= buffer.length)) throw damagedGltf('a buffer ends too early');
  const data = new DataView(buffer.buffer, buffer.byteOffset, buffer.byteLength);
  const [factor, least] = accessor.normalized ? [1 / type.one, -1] : [1, -Infinity];
  const out = new Float32Array(accessor.count * width);
  for (let row = 0; row < accessor.count; row++)
    for (let column = 0; column < width; column++) {
      const value = type.read(data, start + row * stride + column * type.bytes) * factor;
      if (!Number.isFinite(value)) throw damagedGltf(`the values number ${index} are not all finite`);
      out[row * width + column] = Math.max(value, least);
    }
  return out;
}
