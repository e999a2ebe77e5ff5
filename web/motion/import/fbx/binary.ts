import { unzlibSync } from 'fflate';
import { damagedFbx, FbxBudget, type FbxNode, type FbxValue, isSkipped } from './node';

const HEADER_BYTES = 27;
/** First version with 64-bit places of nodes. */
const WIDE_VERSION = 7500;

const ITEM_BYTES: Readonly<Record<string, number>> = { f: 4, d: 8, l: 8, i: 4, b: 1, c: 1 };

const utf8 = new TextDecoder();

/** Reads the nodes of a binary FBX file. */
class BinaryReader {
  private readonly view: DataView;
  private readonly budget = new FbxBudget();
  private at = HEADER_BYTES;
  private readonly wide: boolean;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.wide = this.view.getUint32(23, true) >= WIDE_VERSION;
  }

  /** The nodes up to `end`, or up to the empty node that closes a list. */
  nodes(end: number, depth: number): FbxNode[] {
    const list: FbxNode[] = [];
    while (this.at < end) {
      const node = this.node(end, depth);
      if (node === null) break;
      list.push(node);
    }
    return list;
  }

  private size(): number {
    if (!this.wide) return this.uint32();
    const value = Number(this.view.getBigUint64(this.at, true));
    this.at += 8;
    return value;
  }

  private uint32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }

  private take(count: number): Uint8Array {
    if (!(count >= 0 && this.at + count <= this.bytes.length)) throw damagedFbx('it ends too early');
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }

  private node(limit: number, depth: number): FbxNode | null {
    this.budget.node(depth);
    const end = this.size();
    const count = this.size();
    const valueBytes = this.size();
    const [nameBytes] = this.take(1) as unknown as [number];
    const name = utf8.decode(this.take(nameBytes));
    if (end === 0) return null;
    const valuesEnd = this.at + valueBytes;
    if (end > limit || valuesEnd > end || end <= this.at - 1)
      throw damagedFbx(`the node "${name.slice(0, 24)}" has a wrong length`);
    const values: FbxValue[] = [];
    const children: FbxNode[] = [];
    if (!isSkipped(name)) {
      for (let i = 0; i < count && this.at < valuesEnd; i++) values.push(this.value());
      this.at = valuesEnd;
      if (this.at < end) children.push(...this.nodes(end, depth + 1));
    }
    this.at = end;
    return { name, values, children };
  }

  private value(): FbxValue {
    const type = String.fromCharCode(this.take(1)[0]!);
    const from = this.at;
    switch (type) {
      case 'Y':
        this.at += 2;
        return this.view.getInt16(from, true);
      case 'C':
      case 'B':
        this.at += 1;
        return this.view.getUint8(from);
      case 'Z':
        this.at += 1;
        return this.view.getInt8(from);
      case 'I':
        this.at += 4;
        return this.view.getInt32(from, true);
      case 'F':
        this.at += 4;
        return this.view.getFloat32(from, true);
      case 'D':
        this.at += 8;
        return this.view.getFloat64(from, true);
      case 'L':
        this.at += 8;
        return wholeNumber(this.view.getBigInt64(from, true));
      case 'S':
        return utf8.decode(this.take(this.uint32()));
      case 'R':
        this.take(this.uint32());
        return '';
      default:
        return this.array(type);
    }
  }

  private array(type: string): Float64Array {
    const itemBytes = ITEM_BYTES[type];
    if (itemBytes === undefined) throw damagedFbx(`a value is of the unknown type "${type}"`);
    const [count, encoding, packedBytes] = [this.uint32(), this.uint32(), this.uint32()];
    this.budget.array(count);
    const size = count * itemBytes;
    const packed = this.take(encoding === 0 ? size : packedBytes);
    const content = encoding === 0 ? packed : inflated(packed, size);
    const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
    const out = new Float64Array(count);
    for (let i = 0; i < count; i++) out[i] = item(view, type, i * itemBytes);
    return out;
  }
}

/** As text where a double would round it: an id is that of one object alone. */
function wholeNumber(value: bigint): number | string {
  const number = Number(value);
  return Number.isSafeInteger(number) ? number : String(value);
}

function item(view: DataView, type: string, at: number): number {
  if (type === 'f') return view.getFloat32(at, true);
  if (type === 'd') return view.getFloat64(at, true);
  if (type === 'l') return Number(view.getBigInt64(at, true));
  return type === 'i' ? view.getInt32(at, true) : view.getUint8(at);
}

/** Unpacked bytes, never more than were stated. */
function inflated(packed: Uint8Array, size: number): Uint8Array {
  const out = unzlibSync(packed, { out: new Uint8Array(size) });
  if (out.length !== size) throw damagedFbx('a packed array has another length than stated');
  return out;
}

/**
 * Reads a binary FBX file; meshes, materials and pictures are left out.
 *
 * @throws {AppError} `unreadable-file`
 */
export function readBinary(bytes: Uint8Array): FbxNode[] {
  if (bytes.length < HEADER_BYTES + 13) throw damagedFbx('it ends within its head');
  try {
    return new BinaryReader(bytes).nodes(bytes.length, 0);
  } catch (cause) {
    if (cause instanceof Error && cause.name === 'AppError') throw cause;
    throw damagedFbx('a node can’t be read', cause);
  }
}
