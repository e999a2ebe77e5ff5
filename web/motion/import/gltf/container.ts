import * as v from 'valibot';
import { AppError } from '../../../common/error';

/** Bytes of a file, by its name. */
interface Part {
  readonly name: string;
  readonly bytes: Uint8Array;
}

const index = v.pipe(v.number(), v.integer(), v.minValue(0));
const optionalIndex = v.optional(index);
const count = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(1e8));
const numbers = (length: number) => v.optional(v.pipe(v.array(v.number()), v.length(length)));

/** The part of a glTF file that moves: no meshes, materials, pictures. */
const schema = v.object({
  buffers: v.optional(v.array(v.object({ uri: v.optional(v.string()), byteLength: count })), []),
  bufferViews: v.optional(
    v.array(
      v.object({
        buffer: index,
        byteOffset: v.optional(count, 0),
        byteLength: count,
        byteStride: v.optional(count),
      }),
    ),
    [],
  ),
  accessors: v.optional(
    v.array(
      v.object({
        bufferView: optionalIndex,
        byteOffset: v.optional(count, 0),
        componentType: v.number(),
        normalized: v.optional(v.boolean(), false),
        count,
        type: v.string(),
        sparse: v.optional(
          v.object({
            count,
            indices: v.object({
              bufferView: index,
              byteOffset: v.optional(count, 0),
              componentType: v.number(),
            }),
            values: v.object({ bufferView: index, byteOffset: v.optional(count, 0) }),
          }),
        ),
      }),
    ),
    [],
  ),
  nodes: v.optional(
    v.array(
      v.object({
        name: v.optional(v.string()),
        children: v.optional(v.array(index), []),
        translation: numbers(3),
        rotation: numbers(4),
        scale: numbers(3),
        matrix: numbers(16),
        mesh: optionalIndex,
      }),
    ),
    [],
  ),
  skins: v.optional(v.array(v.object({ joints: v.array(index) })), []),
  animations: v.optional(
    v.array(
      v.object({
        name: v.optional(v.string()),
        samplers: v.array(
          v.object({ input: index, output: index, interpolation: v.optional(v.string(), 'LINEAR') }),
        ),
        channels: v.array(
          v.object({ sampler: index, target: v.object({ node: optionalIndex, path: v.string() }) }),
        ),
      }),
    ),
    [],
  ),
  extensions: v.optional(v.record(v.string(), v.unknown()), {}),
});

export type Gltf = v.InferOutput<typeof schema>;

/** A glTF file with its buffers. */
export interface GltfFile {
  readonly json: Gltf;
  readonly buffers: readonly Uint8Array[];
}

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

/** The error of a file that is not as glTF says. */
export function damagedGltf(what: string, cause?: unknown): AppError {
  return new AppError(
    'unreadable-file',
    `The glTF file is damaged: ${what}.`,
    'Download, copy or export it again, without compression of its animation.',
    { cause },
  );
}

/** The chunks of a GLB file. */
function chunksOf(bytes: Uint8Array): { text: string; binary: Uint8Array | null } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let text: string | null = null;
  let binary: Uint8Array | null = null;
  for (let at = 12; at + 8 <= bytes.length;) {
    const [size, type] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    if (at + 8 + size > bytes.length) throw damagedGltf('it ends too early');
    const chunk = bytes.subarray(at + 8, at + 8 + size);
    if (type === JSON_CHUNK) text ??= new TextDecoder().decode(chunk);
    if (type === BIN_CHUNK) binary ??= chunk;
    at += 8 + size;
  }
  if (text === null) throw damagedGltf('it has no JSON');
  return { text, binary };
}

/** The bytes of a data: address, in base64 or percent-encoded. */
function dataBytes(uri: string): Uint8Array {
  const comma = uri.indexOf(',');
  const [head, body] = [uri.slice(0, comma), uri.slice(comma + 1)];
  const asText = (): string =>
    body.replaceAll(/%([0-9a-f]{2})/gi, (_, byte: string) => String.fromCharCode(parseInt(byte, 16)));
  try {
    const text = /;base64$/i.test(head) ? atob(body) : asText();
    return Uint8Array.from(text, (character) => character.charCodeAt(0));
  } catch (cause) {
    throw damagedGltf('a buffer within it is not in base64', cause);
  }
}

/** A file's name as it is compared: without percent-encoding, umlauts as one character. */
function plainName(name: string): string {
  try {
    return decodeURIComponent(name).normalize();
  } catch {
    return name.normalize();
  }
}

/**
 * Reads a GLB or glTF file with its buffers.
 *
 * @param companions files that the buffers may be in
 * @throws {AppError} `unreadable-file` or `missing-file`
 */
export function readContainer(file: Part, companions: readonly Part[]): GltfFile {
  const { bytes } = file;
  const isGlb =
    bytes.length >= 20 && new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true) === MAGIC;
  const { text, binary } = isGlb ? chunksOf(bytes) : { text: new TextDecoder().decode(bytes), binary: null };
  let raw: unknown;
  try {
    raw = JSON.parse(text);
  } catch (cause) {
    throw damagedGltf('its JSON is not whole', cause);
  }
  const parsed = v.safeParse(schema, raw);
  if (!parsed.success) {
    const path = v.getDotPath(parsed.issues[0]) ?? 'the file';
    throw damagedGltf(`${path.slice(0, 60)} is not as it should be`);
  }
  const json = parsed.output;
  const external = json.buffers.filter(({ uri }) => uri !== undefined && !uri.startsWith('data:')).length;
  const buffers = json.buffers.map(({ uri, byteLength }, number) => {
    if (uri === undefined) {
      if (binary && number === 0) return binary;
      throw damagedGltf('a buffer is missing');
    }
    if (uri.startsWith('data:')) return dataBytes(uri);
    const name = plainName(uri.split('/').at(-1)!);
    const companion =
      companions.find((one) => plainName(one.name) === name) ??
      (companions.length === 1 && external === 1 ? companions[0] : undefined);
    if (companion && companion.bytes.length >= byteLength) return companion.bytes;
    if (companion)
      throw damagedGltf(
        `${companion.name.slice(0, 60)} has ${companion.bytes.length} of its ${byteLength} bytes`,
      );
    throw new AppError(
      'missing-file',
      `The glTF file has its numbers in another file, ${name.slice(0, 60)}.`,
      'Choose or drop both files together, or export as GLB, which is one file.',
    );
  });
  return { json, buffers };
}
