import { type Matrix4, Object3D, Vector3 } from 'three';

type Triple = readonly [number, number, number];

/** A joint of a made file: rest offset from its parent in metres, y up, T-pose facing +z. */
export interface MadeJoint {
  readonly name: string;
  readonly parent: string | null;
  readonly offset: Triple;
  /** Length of an end site below it, in the direction of `end`. */
  readonly end?: Triple;
}

export interface MadeOptions {
  readonly joints: readonly MadeJoint[];
  readonly frames?: number;
  /** As written after "Frame Time:". */
  readonly frameTime?: string;
  readonly unitsPerMetre?: number;
  readonly up?: 'y' | 'z';
  /** Do joints below the root have position channels, and what do these hold? */
  readonly positions?: 'none' | 'whole' | 'added';
  /** Largest angle of any joint in degrees. */
  readonly swing?: number;
  readonly newline?: string;
}

export interface MadeFile {
  readonly text: string;
  /** Place of a joint (or of `end of NAME`) in metres, y up; the floor is wherever it is. */
  readonly at: (name: string, frame: number) => Triple;
}

/** A BVH file with a smooth synthetic motion, and its joint positions computed by three's scene graph. */
export function madeBvh(options: MadeOptions): MadeFile {
  const { joints, frames = 40, frameTime = '0.0333333', unitsPerMetre = 100, up = 'y' } = options;
  const { positions = 'none', swing = 15, newline = '\n' } = options;
  const native = ([x, y, z]: Triple): Triple => (up === 'y' ? [x, y, z] : [x, -z, y]);
  const units = (v: Triple): Triple => native(v).map((value) => value * unitsPerMetre) as unknown as Triple;
  const words = (v: readonly number[]): string => v.map((value) => value.toFixed(6)).join(' ');

  const children = (name: string | null): readonly MadeJoint[] =>
    joints.filter(({ parent }) => parent === name);
  const order: MadeJoint[] = [];
  const hierarchy = (joint: MadeJoint, indent: string): string[] => {
    order.push(joint);
    const withPosition = joint.parent === null || positions !== 'none';
    const channels = withPosition ? '6 Xposition Yposition Zposition' : '3';
    const end = joint.end
      ? [
          `${indent}\tEnd Site`,
          `${indent}\t{`,
          `${indent}\t\tOFFSET ${words(units(joint.end))}`,
          `${indent}\t}`,
        ]
      : [];
    return [
      `${indent}${joint.parent === null ? 'ROOT' : 'JOINT'} ${joint.name}`,
      `${indent}{`,
      `${indent}\tOFFSET ${words(joint.parent === null ? [0, 0, 0] : units(joint.offset))}`,
      `${indent}\tCHANNELS ${channels} Zrotation Xrotation Yrotation`,
      ...children(joint.name).flatMap((child) => hierarchy(child, `${indent}\t`)),
      ...end,
      `${indent}}`,
    ];
  };
  const [root] = children(null);
  const head = [
    'HIERARCHY',
    ...hierarchy(root!, ''),
    'MOTION',
    `Frames: ${frames}`,
    `Frame Time: ${frameTime}`,
  ];

  const objects = new Map(order.map((joint) => [joint.name, new Object3D()]));
  for (const { name, parent, offset } of order) {
    objects.get(name)!.rotation.order = 'ZXY';
    objects.get(name)!.position.set(...units(offset));
    if (parent !== null) objects.get(parent)!.add(objects.get(name)!);
  }
  const angle = (joint: number, axis: number, frame: number): number =>
    Math.round(
      1e4 * swing * Math.sin(0.07 * frame * (1 + ((joint * 7 + axis * 3) % 5) / 5) + joint * 1.3 + axis),
    ) / 1e4;
  const lines: string[] = [];
  const world: Map<string, Matrix4>[] = [];
  for (let frame = 0; frame < frames; frame++) {
    const values: number[] = [];
    order.forEach((joint, index) => {
      const object = objects.get(joint.name)!;
      if (joint.parent === null) {
        const place = units([0.3 * Math.sin(frame / 20), joint.offset[1], 0.2 * Math.cos(frame / 25)]);
        object.position.set(...place);
        values.push(...place);
      } else if (positions === 'whole') {
        values.push(...units(joint.offset));
      } else if (positions === 'added') {
        values.push(0, 0, 0);
      }
      const [z, x, y] = [0, 1, 2].map((axis) => angle(index, axis, frame)) as [number, number, number];
      const radians = Math.PI / 180;
      object.rotation.set(x * radians, y * radians, z * radians, 'ZXY');
      values.push(z, x, y);
    });
    lines.push(words(values));
    objects.get(root!.name)!.updateMatrixWorld(true);
    world.push(new Map([...objects].map(([name, object]) => [name, object.matrixWorld.clone()])));
  }
  return {
    text: [...head, ...lines, ''].join(newline),
    at: (name, frame) => {
      const ended = order.find((joint) => name === `end of ${joint.name}`);
      const local = ended ? units(ended.end!) : ([0, 0, 0] as const);
      const { x, y, z } = new Vector3(...local).applyMatrix4(world[frame]!.get(ended?.name ?? name)!);
      const metres = [x, y, z].map((value) => value / unitsPerMetre) as [number, number, number];
      return up === 'y' ? metres : [metres[0], metres[2], -metres[1]];
    },
  };
}

/** Names of the parts of a made body; parts without a name are left out of the file. */
export interface BodyNames {
  readonly root: string;
  readonly spine: readonly string[];
  readonly neck?: string;
  readonly head?: string;
  /** Per side: `*` is replaced by the two words of `sides`. */
  readonly sides: readonly [string, string];
  readonly hip?: string;
  readonly knee?: string;
  readonly ankle?: string;
  readonly toe?: string;
  readonly collar?: string;
  readonly shoulder?: string;
  readonly elbow?: string;
  readonly wrist?: string;
}

/** Height of the neck above the root, shared out among the spine joints. */
const NECK_HEIGHT = 0.5;

/** A person's body under a family's names. A part without a name is skipped, and what hangs on it moves inwards. */
export function madeBody(names: BodyNames): MadeJoint[] {
  const joints: MadeJoint[] = [{ name: names.root, parent: null, offset: [0, 0.95, 0] }];
  const step = NECK_HEIGHT / (names.spine.length + 1);
  let top = names.root;
  for (const name of names.spine) {
    joints.push({ name, parent: top, offset: [0, step, 0] });
    top = name;
  }
  let above = top;
  if (names.neck !== undefined) {
    joints.push({ name: names.neck, parent: above, offset: [0, step, 0] });
    above = names.neck;
  }
  if (names.head !== undefined) {
    const offset: Triple = names.neck === undefined ? [0, step + 0.1, 0] : [0, 0.1, 0];
    joints.push({ name: names.head, parent: above, offset, end: [0, 0.15, 0] });
  }
  names.sides.forEach((side, i) => {
    const mirror = i === 0 ? 1 : -1;
    const chain = (
      start: string,
      parts: readonly (readonly [string | undefined, Triple, Triple?])[],
    ): void => {
      let parent = start;
      let skipped: Triple = [0, 0, 0];
      for (const [part, offset, end] of parts) {
        const moved = offset.map(
          (value, axis) => value * (axis === 0 ? mirror : 1) + skipped[axis]!,
        ) as unknown as Triple;
        if (part === undefined) {
          skipped = moved;
          continue;
        }
        const name = part.replace('*', side);
        const tip = end && (end.map((value, axis) => value * (axis === 0 ? mirror : 1)) as unknown as Triple);
        joints.push({ name, parent, offset: moved, ...(tip ? { end: tip } : {}) });
        parent = name;
        skipped = [0, 0, 0];
      }
    };
    chain(names.root, [
      [names.hip, [0.09, -0.04, 0]],
      [names.knee, [0, -0.42, 0]],
      [names.ankle, [0, -0.41, 0]],
      [names.toe, [0, -0.05, 0.12], [0, 0, 0.05]],
    ]);
    chain(top, [
      [names.collar, [0.05, step - 0.05, 0]],
      [names.shoulder, [0.13, 0, 0]],
      [names.elbow, [0.27, 0, 0]],
      [names.wrist, [0.24, 0, 0], [0.1, 0, 0]],
    ]);
  });
  return joints;
}

/** The names of Mixamo's rig, the plainest of the families. */
export const MIXAMO: BodyNames = {
  root: 'mixamorig:Hips',
  spine: ['mixamorig:Spine', 'mixamorig:Spine1', 'mixamorig:Spine2'],
  neck: 'mixamorig:Neck',
  head: 'mixamorig:Head',
  sides: ['Left', 'Right'],
  hip: 'mixamorig:*UpLeg',
  knee: 'mixamorig:*Leg',
  ankle: 'mixamorig:*Foot',
  toe: 'mixamorig:*ToeBase',
  collar: 'mixamorig:*Shoulder',
  shoulder: 'mixamorig:*Arm',
  elbow: 'mixamorig:*ForeArm',
  wrist: 'mixamorig:*Hand',
};
