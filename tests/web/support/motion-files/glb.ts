import type { MadeMotion } from './made-motion';
import { conjugate, multiply, type Quat, rotate } from '../../../../web/motion/math/quat';
import type { Vec3 } from '../../../../web/motion/math/vec3';

interface Options {
  /** Names of clips; all but the first stand still. */
  readonly clips?: readonly string[];
  readonly interpolation?: 'LINEAR' | 'CUBICSPLINE' | 'STEP';
  /** Seconds of the first key. */
  readonly begin?: number;
  /** Rotations as normalised whole numbers of two bytes in place of floats. */
  readonly shorts?: boolean;
  /** Bytes between the values of a list, as where several lists are interleaved. */
  readonly gap?: number;
  /** Bones of a VRM humanoid by the joints' names, for a VRMA or a VRM file. */
  readonly humanoid?: { readonly extension: string; readonly bones: ReadonlyMap<string, string> };
  /** A scaled and turned node above the root, as Blender writes armatures. */
  readonly armature?: boolean;
  /** The armature's scale as keys, not as that of its node. */
  readonly scaleKeys?: boolean;
  /** Rest rotation of every joint, as avatars have them. */
  readonly restTurn?: Quat;
  /** Sizes of the rest offsets, for a body of other proportions. */
  readonly grown?: number;
}

/** Numbers in a buffer, as accessors of a glTF file. */
class Buffers {
  readonly accessors: object[] = [];
  readonly views: object[] = [];
  private readonly parts: Uint8Array[] = [];
  private length = 0;

  /** @param gap bytes after every value */
  add(
    values: readonly number[],
    type: 'SCALAR' | 'VEC3' | 'VEC4',
    width: number,
    { shorts = false, gap = 0 }: { shorts?: boolean; gap?: number } = {},
  ): number {
    const size = shorts ? 2 : 4;
    const stride = width * size + gap;
    const data = new DataView(new ArrayBuffer((values.length / width) * stride));
    values.forEach((value, i) => {
      const at = Math.floor(i / width) * stride + (i % width) * size;
      if (shorts) data.setInt16(at, Math.round(value * 32767), true);
      else data.setFloat32(at, value, true);
    });
    this.views.push({
      buffer: 0,
      byteOffset: this.length,
      byteLength: data.byteLength,
      ...(gap > 0 && { byteStride: stride }),
    });
    this.parts.push(new Uint8Array(data.buffer));
    this.length += data.byteLength;
    return (
      this.accessors.push({
        bufferView: this.views.length - 1,
        componentType: shorts ? 5122 : 5126,
        ...(shorts && { normalized: true }),
        count: values.length / width,
        type,
        ...(type === 'SCALAR' && { min: [Math.min(...values)], max: [Math.max(...values)] }),
      }) - 1
    );
  }

  bytes(): Uint8Array<ArrayBuffer> {
    const out = new Uint8Array(this.length);
    let at = 0;
    for (const part of this.parts) {
      out.set(part, at);
      at += part.length;
    }
    return out;
  }
}

/** Doubled quaternions of opposite sign are the same rotation; a spline must not go through zero. */
function continuous(rows: readonly Quat[]): Quat[] {
  const out: Quat[] = [];
  for (const q of rows) {
    const before = out.at(-1);
    const dot = before ? q.reduce((sum, value, i) => sum + value * before[i]!, 0) : 1;
    out.push(dot < 0 ? (q.map((value) => -value) as unknown as Quat) : q);
  }
  return out;
}

/** The JSON and the numbers of a glTF file with the made motion. */
function contentOf(motion: MadeMotion, options: Options): { json: object; bytes: Uint8Array<ArrayBuffer> } {
  const { clips = ['dance'], interpolation = 'LINEAR', armature = false, restTurn = [0, 0, 0, 1] } = options;
  const { humanoid, grown = 1, begin = 0, shorts = false, gap = 0, scaleKeys = false } = options;
  const buffers = new Buffers();
  // World rest rotation of joint j is restTurn for all but the root's parent.
  const above = (joint: number): Quat => (motion.joints[joint]!.parent < 0 ? [0, 0, 0, 1] : restTurn);
  const place = (joint: number, v: Vec3): Vec3 => {
    const scaled: Vec3 = [v[0] * grown, v[1] * grown, v[2] * grown];
    const [x, y, z] = rotate(conjugate(above(joint)), scaled);
    return armature && motion.joints[joint]!.parent < 0 ? [100 * x, -100 * z, 100 * y] : [x, y, z];
  };
  const quarter: Quat = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
  const turn = (joint: number, q: Quat): Quat => {
    const local = multiply(multiply(conjugate(above(joint)), q), restTurn);
    return armature && motion.joints[joint]!.parent < 0 ? multiply(conjugate(quarter), local) : local;
  };
  const rootPlaces = motion.root.map((v) => place(0, v));
  const nodes: Record<string, unknown>[] = motion.joints.map(({ name, offset }, joint) => ({
    name,
    translation: place(joint, offset),
    rotation: turn(joint, [0, 0, 0, 1]),
    children: motion.joints.flatMap(({ parent }, child) => (parent === joint ? [child] : [])),
  }));
  if (armature) {
    // One hundredth of the size; the first joint is a hundred times larger again.
    nodes[0]!['scale'] = [100, 100, 100];
    const scale = scaleKeys ? {} : { scale: [0.01, 0.01, 0.01] };
    nodes.push({ name: 'Armature', rotation: quarter, ...scale, children: [0] });
  }
  for (const one of nodes) if ((one['children'] as unknown[]).length === 0) delete one['children'];
  const times = buffers.add(
    motion.root.map((_, frame) => begin + frame / motion.fps),
    'SCALAR',
    1,
  );
  const spline = (rows: readonly (readonly number[])[]): number[] =>
    interpolation !== 'CUBICSPLINE'
      ? rows.flat()
      : rows.flatMap((row, i) => {
          const [before, after] = [rows[Math.max(0, i - 1)]!, rows[Math.min(rows.length - 1, i + 1)]!];
          const tangent = row.map((_, axis) => ((after[axis]! - before[axis]!) / 2) * motion.fps);
          return [...tangent, ...row, ...tangent];
        });
  const animations = clips.map((name, clip) => {
    const samplers: object[] = [];
    const channels: object[] = [];
    const animate = (
      node: number,
      path: string,
      rows: readonly (readonly number[])[],
      type: 'VEC3' | 'VEC4',
    ) => {
      const kept = clip === 0 ? rows : rows.map(() => rows[0]!);
      const output = buffers.add(spline(kept), type, type === 'VEC3' ? 3 : 4, {
        shorts: shorts && path === 'rotation',
        gap,
      });
      channels.push({
        sampler: samplers.push({ input: times, output, interpolation }) - 1,
        target: { node, path },
      });
    };
    animate(0, 'translation', rootPlaces, 'VEC3');
    const scales = rootPlaces.map(() => [0.01, 0.01, 0.01]);
    if (scaleKeys) animate(motion.joints.length, 'scale', scales, 'VEC3');
    motion.joints.forEach((_, joint) =>
      animate(
        joint,
        'rotation',
        continuous(motion.rotations.map((turns) => turn(joint, turns[joint]!))),
        'VEC4',
      ),
    );
    return { name, samplers, channels };
  });
  const bytes = buffers.bytes();
  const bones =
    humanoid &&
    [...humanoid.bones].flatMap(([joint, bone]) => {
      const node = motion.joints.findIndex(({ name }) => name === joint);
      return node < 0 ? [] : [[bone, { node }] as const];
    });
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [armature ? motion.joints.length : 0] }],
    nodes,
    animations: clips.length > 0 ? animations : undefined,
    accessors: buffers.accessors,
    bufferViews: buffers.views,
    buffers: [{ byteLength: bytes.length }],
    ...(humanoid &&
      bones && {
        extensionsUsed: [humanoid.extension],
        extensions: {
          [humanoid.extension]: { specVersion: '1.0', humanoid: { humanBones: Object.fromEntries(bones) } },
        },
      }),
  };
  return { json, bytes };
}

const utf8 = (text: string): Uint8Array<ArrayBuffer> => new TextEncoder().encode(text);

/** The motion as a GLB file. */
export function writeGlb(motion: MadeMotion, options: Options = {}): Uint8Array<ArrayBuffer> {
  const { json, bytes } = contentOf(motion, options);
  return packed(json, bytes);
}

function packed(json: object, bytes: Uint8Array): Uint8Array<ArrayBuffer> {
  const plain = JSON.stringify(json);
  const text = utf8(plain.padEnd(Math.ceil(plain.length / 4) * 4));
  const out = new Uint8Array(12 + 8 + text.length + 8 + bytes.length);
  const view = new DataView(out.buffer);
  [0x46546c67, 2, out.length, text.length, 0x4e4f534a].forEach((word, i) =>
    view.setUint32(4 * i, word, true),
  );
  out.set(text, 20);
  view.setUint32(20 + text.length, bytes.length, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  out.set(bytes, 28 + text.length);
  return out;
}

/** The parts of a GLB file's JSON that tests change. */
interface GlbJson {
  scenes: { nodes: number[] }[];
  nodes: {
    name: string;
    children?: number[];
    mesh?: number;
    skin?: number;
    matrix?: number[];
    scale?: number[];
  }[];
  skins?: { joints: number[] }[];
  meshes?: object[];
  animations: {
    name: string;
    samplers: { input: number; output: number }[];
    channels: { sampler: number; target: { node: number; path: string } }[];
  }[];
  accessors: { bufferView: number; count: number }[];
  bufferViews: { byteOffset: number }[];
  buffers: { byteLength: number }[];
  extensions?: Record<string, object>;
}

function unpacked(glb: Uint8Array<ArrayBuffer>): { json: GlbJson; bytes: Uint8Array } {
  const end = 20 + new DataView(glb.buffer).getUint32(12, true);
  return {
    json: JSON.parse(new TextDecoder().decode(glb.subarray(20, end))) as GlbJson,
    bytes: glb.subarray(end + 8),
  };
}

/** A GLB file with its JSON changed. */
export function changedGlb(
  glb: Uint8Array<ArrayBuffer>,
  change: (json: GlbJson) => void,
): Uint8Array<ArrayBuffer> {
  const { json, bytes } = unpacked(glb);
  change(json);
  return packed(json, bytes);
}

/** Puts the first two clips of a file into one. */
export function joinClips({ animations }: GlbJson): void {
  const [first, second] = animations.splice(0) as [(typeof animations)[0], (typeof animations)[0]];
  for (const { sampler, target } of second.channels)
    first.channels.push({ sampler: sampler + first.samplers.length, target });
  first.samplers.push(...second.samplers);
  animations.push(first);
}

/** Two GLB files in one: the nodes and the clips of both, side by side. */
export function joinedGlb(
  first: Uint8Array<ArrayBuffer>,
  second: Uint8Array<ArrayBuffer>,
): Uint8Array<ArrayBuffer> {
  const [a, b] = [unpacked(first), unpacked(second)];
  const [nodes, views, accessors] = [a.json.nodes.length, a.json.bufferViews.length, a.json.accessors.length];
  for (const node of b.json.nodes) node.children = (node.children ?? []).map((child) => child + nodes);
  for (const view of b.json.bufferViews) view.byteOffset += a.bytes.length;
  for (const accessor of b.json.accessors) accessor.bufferView += views;
  for (const { samplers, channels } of b.json.animations) {
    for (const sampler of samplers) {
      sampler.input += accessors;
      sampler.output += accessors;
    }
    for (const { target } of channels) target.node += nodes;
  }
  const json: GlbJson = {
    ...a.json,
    scenes: [{ nodes: [...a.json.scenes[0]!.nodes, ...b.json.scenes[0]!.nodes.map((node) => node + nodes)] }],
    nodes: [...a.json.nodes, ...b.json.nodes],
    animations: [...a.json.animations, ...b.json.animations],
    accessors: [...a.json.accessors, ...b.json.accessors],
    bufferViews: [...a.json.bufferViews, ...b.json.bufferViews],
    buffers: [{ byteLength: a.bytes.length + b.bytes.length }],
  };
  return packed(json, Uint8Array.from([...a.bytes, ...b.bytes]));
}

/** The motion as a glTF file, its numbers within it or in a file beside it. */
export function writeGltf(motion: MadeMotion, uri: string | null): { gltf: Uint8Array; bin: Uint8Array } {
  const { json, bytes } = contentOf(motion, {});
  const address = uri ?? `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
  const whole = { ...json, buffers: [{ byteLength: bytes.length, uri: address }] };
  return { gltf: utf8(JSON.stringify(whole)), bin: bytes };
}
