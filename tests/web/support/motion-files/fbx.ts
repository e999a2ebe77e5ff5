import { zlibSync } from 'fflate';
import { Euler, Quaternion } from 'three';
import { inFile, type MadeMotion } from './made-motion';
import { aboutAxis, conjugate, multiply, type Quat } from '../../../../web/motion/math/quat';
import { X_AXIS, Y_AXIS, Z_AXIS, type Vec3 } from '../../../../web/motion/math/vec3';

/** A value with its FBX type. */
export type Value =
  ['I' | 'L' | 'D' | 'S' | 'Z', number | bigint | string] | ['l' | 'f' | 'd' | 'c', readonly number[]];

export interface Node {
  readonly name: string;
  readonly values: readonly Value[];
  readonly children: readonly Node[];
}

export const node = (name: string, values: readonly Value[] = [], children: readonly Node[] = []): Node => ({
  name,
  values,
  children,
});

export const TICKS = 46_186_158_000;
const DEGREES = 180 / Math.PI;
/** Scales of the two objects above an armature. */
const [OUTER_SCALE, INNER_SCALE] = [50, 2];

interface Options {
  readonly up?: 'y' | 'z';
  readonly unitsPerMetre?: number;
  /** Rotation of each joint's own axes before its animation, as Mixamo and MotionBuilder write it. */
  readonly preRotation?: boolean;
  /** Number of the order in which every joint turns about its axes; the values written are those of the first order. */
  readonly rotationOrder?: number;
  /** Degrees about x, y and z that every joint is turned back after its animation. */
  readonly postRotation?: Vec3;
  /** Seconds of the first key. */
  readonly begin?: number;
  /** Number of the frame rate in the settings, and the rate that number 14 stands for. */
  readonly timeMode?: number;
  readonly customRate?: number;
  /** Version 7.5, in which the places of nodes have 64 bits. */
  readonly wide?: boolean;
  /** Names of clips; the second one stands still. */
  readonly clips?: readonly string[];
  /** Name of a clip of one key before them. */
  readonly pose?: string;
  /** Added to the number of every object, for files of several dancers. */
  readonly firstId?: bigint;
  /** What real files have beside joints and their motion: a mesh, attributes, curves of other properties, an empty clip. */
  readonly others?: boolean;
  /** Joints a hundred times smaller below two scaled objects, as Blender writes armatures; the clips hold one scale. */
  readonly armature?: boolean;
}

export const property = (name: string, type: string, ...values: Value[]): Node =>
  node('P', [['S', name], ['S', type], ['S', ''], ['S', 'A'], ...values]);

export const vector = (name: string, v: Vec3): Node =>
  property(name, name.startsWith('Lcl') ? name : 'Vector3D', ...v.map((value): Value => ['D', value]));

/** Angles about x, then y, then z, degrees. */
function eulerXyz(q: Quat): Vec3 {
  const { x, y, z } = new Euler().setFromQuaternion(new Quaternion(...q), 'ZYX');
  return [x * DEGREES, y * DEGREES, z * DEGREES];
}

const native = (q: Quat, up: 'y' | 'z'): Quat => (up === 'y' ? q : [q[0], -q[2], q[1], q[3]]);

/** Nodes of a file with the made motion. */
function nodesOf(motion: MadeMotion, options: Options): Node[] {
  const {
    up = 'y',
    unitsPerMetre = 100,
    preRotation = false,
    clips = ['Take 001'],
    firstId = 0n,
    others = false,
    armature = false,
    pose,
    rotationOrder = 0,
    postRotation,
    begin = 0,
    timeMode = 6,
    customRate,
  } = options;
  const objects: Node[] = [];
  const links: Node[] = [];
  const link = (child: bigint, parent: bigint, prop?: string): void => {
    const values: Value[] = [
      ['S', prop === undefined ? 'OO' : 'OP'],
      ['L', child],
      ['L', parent],
    ];
    links.push(node('C', prop === undefined ? values : [...values, ['S', prop]]));
  };
  const pre = motion.joints.map((_, i): Quat =>
    preRotation
      ? multiply(
          aboutAxis(Z_AXIS, 0.4 * i),
          multiply(aboutAxis(Y_AXIS, 0.9 - 0.2 * i), aboutAxis(X_AXIS, 0.3 * i)),
        )
      : [0, 0, 0, 1],
  );
  // The axes of a joint are those of its parent turned by both pre-rotations of the chain.
  const world: Quat[] = [];
  motion.joints.forEach(({ parent }, i) =>
    world.push(parent < 0 ? pre[i]! : multiply(world[parent]!, pre[i]!)),
  );
  const above = (joint: number): Quat => {
    const { parent } = motion.joints[joint]!;
    return parent < 0 ? [0, 0, 0, 1] : world[parent]!;
  };
  const local = (v: Vec3, joint: number): Vec3 => {
    const rotated = multiply(multiply(conjugate(above(joint)), [...v, 0] as unknown as Quat), above(joint));
    return [rotated[0], rotated[1], rotated[2]];
  };
  const id = (joint: number): bigint => firstId + BigInt(1_000_000 + joint);
  let next = firstId + 2_000_000n;
  const [mesh, outer, inner] = [next++, next++, next++];
  const grown = armature ? OUTER_SCALE * INNER_SCALE : 1;
  if (armature) {
    const scaled = (number: bigint, name: string, scale: number): Node =>
      node(
        'Model',
        [
          ['L', number],
          ['S', `${name}\0\u0001Model`],
          ['S', 'Null'],
        ],
        [node('Properties70', [], [vector('Lcl Scaling', [scale, scale, scale])])],
      );
    objects.push(scaled(outer, 'Scene', OUTER_SCALE), scaled(inner, 'Armature', 1));
    link(outer, 0n);
    link(inner, outer);
  }
  if (others) {
    const [geometry, attribute, stack] = [next++, next++, next++];
    const object = (kind: string, number: bigint, name: string, type: string, ...inside: Node[]): Node =>
      node(
        kind,
        [
          ['L', number],
          ['S', `${name}\0\u0001${kind}`],
          ['S', type],
        ],
        inside,
      );
    objects.push(
      object('NodeAttribute', attribute, 'Hips', 'LimbNode', node('TypeFlags', [['S', 'Skeleton']])),
      object('Geometry', geometry, 'Body', 'Mesh', node('Vertices', [['d', [0, 0, 0, 1, 1, 1, 2, 0, 2]]])),
      object('Model', mesh, motion.joints[0]!.name, 'Mesh', node('Culling', [['S', 'CullingOff']])),
    );
    objects.push(object('AnimationStack', stack, 'Nothing', ''));
    link(attribute, id(0));
    link(geometry, mesh);
    link(mesh, 0n);
  }
  motion.joints.forEach(({ name, parent, offset }, joint) => {
    objects.push(
      node(
        'Model',
        [
          ['L', id(joint)],
          ['S', `${name}\0\u0001Model`],
          ['S', 'LimbNode'],
        ],
        [
          node(
            'Properties70',
            [],
            [
              property('RotationActive', 'bool', ['I', 1]),
              property('RotationOrder', 'enum', ['I', rotationOrder]),
              vector('PreRotation', eulerXyz(pre[joint]!)),
              ...(postRotation ? [vector('PostRotation', postRotation)] : []),
              vector('Lcl Translation', local(inFile(offset, unitsPerMetre / grown, up), joint)),
            ],
          ),
        ],
      ),
    );
    link(id(joint), parent < 0 ? (armature ? inner : 0n) : id(parent));
  });
  const times = Array.from({ length: motion.frames }, (_, frame) =>
    Math.round((begin + frame / motion.fps) * TICKS),
  );
  [...(pose === undefined ? [] : [pose]), ...clips].forEach((clip, number) => {
    const keys = clip === pose ? 1 : motion.frames;
    const isStill = number > 0 && clip !== clips[0];
    const [stack, layer] = [next++, next++];
    objects.push(
      node('AnimationStack', [
        ['L', stack],
        ['S', `${clip}\0\u0001AnimStack`],
        ['S', ''],
      ]),
    );
    objects.push(
      node('AnimationLayer', [
        ['L', layer],
        ['S', 'Base\0\u0001AnimLayer'],
        ['S', ''],
      ]),
    );
    link(layer, stack);
    if (others) {
      // A mesh that has another colour long after the dance.
      const [colour, curve] = [next++, next++];
      objects.push(
        node('AnimationCurveNode', [
          ['L', colour],
          ['S', 'Color\0\u0001AnimCurveNode'],
          ['S', ''],
        ]),
        node(
          'AnimationCurve',
          [
            ['L', curve],
            ['S', '\0\u0001AnimCurve'],
            ['S', ''],
          ],
          [node('KeyTime', [['l', [0, 100 * TICKS]]]), node('KeyValueFloat', [['f', [0, 1]]])],
        ),
      );
      link(colour, layer);
      link(colour, mesh, 'Color');
      link(curve, colour, 'd|X');
    }
    const animate = (model: bigint, name: string, rows: readonly Vec3[]): void => {
      const curves = next++;
      objects.push(
        node('AnimationCurveNode', [
          ['L', curves],
          ['S', `${name.at(4)!}\0\u0001AnimCurveNode`],
          ['S', ''],
        ]),
      );
      link(curves, layer);
      link(curves, model, name);
      // A constraint takes the same values.
      if (others) link(curves, firstId + 9_000_000n, 'Source');
      (['X', 'Y', 'Z'] as const).forEach((axis, i) => {
        const curve = next++;
        const values = rows.map((row) => row[i]!);
        objects.push(
          node(
            'AnimationCurve',
            [
              ['L', curve],
              ['S', '\0\u0001AnimCurve'],
              ['S', ''],
            ],
            [
              node('KeyTime', [['l', times.slice(0, keys)]]),
              node('KeyValueFloat', [['f', isStill ? values.map(() => values[0]!) : values.slice(0, keys)]]),
            ],
          ),
        );
        link(curve, curves, `d|${axis}`);
      });
    };
    animate(
      id(0),
      'Lcl Translation',
      motion.root.map((place) => local(inFile(place, unitsPerMetre / grown, up), 0)),
    );
    if (armature)
      animate(
        inner,
        'Lcl Scaling',
        motion.root.map(() => [INNER_SCALE, INNER_SCALE, INNER_SCALE]),
      );
    motion.joints.forEach((_, joint) => {
      // World axes of the joint before its own rotation are those of the chain of pre-rotations.
      const w = world[joint]!;
      animate(
        id(joint),
        'Lcl Rotation',
        motion.rotations.map((turns) =>
          eulerXyz(multiply(multiply(conjugate(w), native(turns[joint]!, up)), w)),
        ),
      );
    });
  });
  const settings = node(
    'GlobalSettings',
    [],
    [
      node(
        'Properties70',
        [],
        [
          property('UpAxis', 'int', ['I', up === 'y' ? 1 : 2]),
          property('UpAxisSign', 'int', ['I', 1]),
          property('UnitScaleFactor', 'double', ['D', 100 / unitsPerMetre]),
          property('TimeMode', 'enum', ['I', timeMode]),
          ...(customRate === undefined ? [] : [property('CustomFrameRate', 'double', ['D', customRate])]),
        ],
      ),
    ],
  );
  return [settings, node('Objects', [], objects), node('Connections', [], links)];
}

class Bytes {
  private readonly parts: number[] = [];
  get length(): number {
    return this.parts.length;
  }
  push(...bytes: readonly number[]): void {
    for (const byte of bytes) this.parts.push(byte);
  }
  number(bytes: number, write: (view: DataView) => void): void {
    const view = new DataView(new ArrayBuffer(bytes));
    write(view);
    this.push(...new Uint8Array(view.buffer));
  }
  uint32(value: number): void {
    this.number(4, (view) => view.setUint32(0, value, true));
  }
  patch(at: number, value: number): void {
    for (let i = 0; i < 4; i++) this.parts[at + i] = (value >>> (8 * i)) & 255;
  }
  result(): Uint8Array<ArrayBuffer> {
    return Uint8Array.from(this.parts);
  }
}

function writeValue(out: Bytes, [type, value]: Value, packed: boolean): void {
  out.push(type.charCodeAt(0));
  if (typeof value === 'string') {
    const bytes = new TextEncoder().encode(value);
    out.uint32(bytes.length);
    out.push(...bytes);
  } else if (typeof value === 'number' || typeof value === 'bigint') {
    if (type === 'Z') out.number(1, (view) => view.setInt8(0, Number(value)));
    else if (type === 'I') out.number(4, (view) => view.setInt32(0, Number(value), true));
    else if (type === 'L') out.number(8, (view) => view.setBigInt64(0, BigInt(value), true));
    else out.number(8, (view) => view.setFloat64(0, Number(value), true));
  } else {
    const size = type === 'c' ? 1 : type === 'f' ? 4 : 8;
    const view = new DataView(new ArrayBuffer(size * value.length));
    value.forEach((one, i) => {
      if (type === 'c') view.setUint8(i, one);
      else if (type === 'f') view.setFloat32(size * i, one, true);
      else if (type === 'l') view.setBigInt64(size * i, BigInt(one), true);
      else view.setFloat64(size * i, one, true);
    });
    const plain = new Uint8Array(view.buffer);
    const content = packed ? zlibSync(plain) : plain;
    out.uint32(value.length);
    out.uint32(packed ? 1 : 0);
    out.uint32(content.length);
    out.push(...content);
  }
}

function writeNode(out: Bytes, { name, values, children }: Node, packed: boolean, wide: boolean): void {
  const word = wide ? 8 : 4;
  const start = out.length;
  out.push(...new Array<number>(3 * word).fill(0), name.length, ...new TextEncoder().encode(name));
  const valuesStart = out.length;
  for (const value of values) writeValue(out, value, packed);
  out.patch(start + word, values.length);
  out.patch(start + 2 * word, out.length - valuesStart);
  for (const child of children) writeNode(out, child, packed, wide);
  if (children.length > 0) out.push(...new Array<number>(3 * word + 1).fill(0));
  out.patch(start, out.length);
}

/** The motion as a binary FBX file of version 7.4, or 7.5. */
export function writeFbxBinary(
  motion: MadeMotion,
  options: Options = {},
  packed = true,
): Uint8Array<ArrayBuffer> {
  return binaryFbx(nodesOf(motion, options), packed, options.wide);
}

/** Two dancers with a clip each as a binary FBX file. */
export function writeFbxDuet(
  dancers: readonly [MadeMotion, MadeMotion],
  clips: readonly [string, string],
): Uint8Array<ArrayBuffer> {
  const [a, b] = dancers.map((motion, i) =>
    nodesOf(motion, { clips: [clips[i]!], firstId: BigInt(i) * 10_000_000n }),
  ) as [Node[], Node[]];
  return binaryFbx(
    a.map((top, i) =>
      top.name === 'GlobalSettings' ? top : node(top.name, [], [...top.children, ...b[i]!.children]),
    ),
    true,
  );
}

export function binaryFbx(nodes: readonly Node[], packed: boolean, wide = false): Uint8Array<ArrayBuffer> {
  const out = new Bytes();
  out.push(...new TextEncoder().encode('Kaydara FBX Binary  \0'), 0x1a, 0);
  out.uint32(wide ? 7500 : 7400);
  for (const top of nodes) writeNode(out, top, packed, wide);
  out.push(...new Array<number>(wide ? 25 : 13).fill(0));
  return out.result();
}

function asciiNode({ name, values, children }: Node, indent: string): string {
  const array =
    values.length === 1 && Array.isArray(values[0]![1]) ? (values[0]![1] as readonly number[]) : null;
  if (array) return `${indent}${name}: *${array.length} {\n${indent}\ta: ${array.join(',')}\n${indent}}`;
  const words = values.map(([type, value]) => {
    if (type !== 'S') return String(value);
    const [plain = '', kind] = String(value).split('\0\u0001');
    return kind === undefined ? `"${plain}"` : `"${kind}::${plain}"`;
  });
  const head = `${indent}${name}: ${words.join(', ')}`;
  if (children.length === 0) return head;
  return `${head} {\n${children.map((child) => asciiNode(child, `${indent}\t`)).join('\n')}\n${indent}}`;
}

/** The motion as the text form of FBX. */
export function writeFbxAscii(motion: MadeMotion, options: Options = {}): Uint8Array<ArrayBuffer> {
  const nodes = nodesOf(motion, options).map((top) => asciiNode(top, ''));
  return new TextEncoder().encode(`; FBX 7.4.0 project file\n; ----\n; {Objects}\n\n${nodes.join('\n')}\n`);
}
