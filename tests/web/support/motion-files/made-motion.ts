import { type BodyNames, madeBody, type MadeFile, type MadeJoint, MIXAMO } from '../made-bvh';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import { J, JOINT_COUNT, type JointName } from '../../../../web/motion/skeleton/skeleton';
import { aboutAxis, multiply, type Quat, rotate } from '../../../../web/motion/math/quat';
import {
  add,
  distance,
  readVec,
  type Vec3,
  X_AXIS,
  Y_AXIS,
  Z_AXIS,
  ZERO,
} from '../../../../web/motion/math/vec3';

/** A motion whose every joint is known: what the writers of the formats write, and what is expected of their readers. */
export interface MadeMotion {
  readonly names: BodyNames;
  /** Depth first. */
  readonly joints: readonly { readonly name: string; readonly parent: number; readonly offset: Vec3 }[];
  readonly fps: number;
  readonly frames: number;
  /** Local rotations and the root's place by frame, metres, y up. */
  readonly rotations: readonly (readonly Quat[])[];
  readonly root: readonly Vec3[];
  /** World positions by frame. */
  readonly places: readonly (readonly Vec3[])[];
}

interface Options {
  readonly names?: BodyNames;
  readonly frames?: number;
  readonly fps?: number;
  /** Largest angle of a joint, degrees. */
  readonly swing?: number;
  readonly body?: readonly MadeJoint[];
}

export function madeMotion({
  names = MIXAMO,
  frames = 40,
  fps = 30,
  swing = 15,
  body = madeBody(names),
}: Options = {}): MadeMotion {
  const joints: { name: string; parent: number; offset: Vec3 }[] = [];
  const visit = (parentName: string | null, parent: number): void => {
    for (const joint of body.filter((one) => one.parent === parentName)) {
      const index = joints.push({ name: joint.name, parent, offset: joint.offset }) - 1;
      visit(joint.name, index);
    }
  };
  visit(null, -1);
  const angle = (joint: number, axis: number, frame: number): number =>
    ((swing * Math.PI) / 180) *
    Math.sin(((2.1 * frame) / fps) * (1 + ((joint * 7 + axis * 3) % 5) / 5) + joint * 1.3 + axis);
  const rotations = Array.from({ length: frames }, (_, frame) =>
    joints.map((_joint, joint) =>
      multiply(
        multiply(aboutAxis(Z_AXIS, angle(joint, 0, frame)), aboutAxis(X_AXIS, angle(joint, 1, frame))),
        aboutAxis(Y_AXIS, angle(joint, 2, frame)),
      ),
    ),
  );
  const root = Array.from({ length: frames }, (_, frame): Vec3 => {
    const seconds = frame / fps;
    return [0.3 * Math.sin(1.5 * seconds), joints[0]!.offset[1], 0.2 * Math.cos(1.2 * seconds)];
  });
  const places = rotations.map((turns, frame) => placed(joints, turns, root[frame]!));
  return { names, joints, fps, frames, rotations, root, places };
}

function placed(joints: MadeMotion['joints'], turns: readonly Quat[], root: Vec3): Vec3[] {
  const world: Quat[] = [];
  const places: Vec3[] = [];
  joints.forEach(({ parent, offset }, joint) => {
    world.push(parent < 0 ? turns[joint]! : multiply(world[parent]!, turns[joint]!));
    places.push(parent < 0 ? root : add(places[parent]!, rotate(world[parent]!, offset)));
  });
  return places;
}

/** The places of a made BVH file's joints, for `worstMillimetres`. */
export function bvhMotion(
  made: MadeFile,
  names: BodyNames,
  frames: number,
): Pick<MadeMotion, 'names' | 'joints' | 'places'> {
  const joints = madeBody(names).map(({ name }) => ({ name, parent: -1, offset: ZERO }));
  const places = Array.from({ length: frames }, (_, frame) => joints.map(({ name }) => made.at(name, frame)));
  return { names, joints, places };
}

/** Which joint of ours each named part of a made body is. */
export function pairsOf(names: BodyNames): (readonly [JointName, string])[] {
  const parts = {
    hip: 'hip',
    knee: 'knee',
    ankle: 'ankle',
    toe: 'foot',
    collar: 'collar',
    shoulder: 'shoulder',
    elbow: 'elbow',
    wrist: 'wrist',
  } as const;
  const pairs: (readonly [JointName, string])[] = [];
  for (const [part, ours] of Object.entries(parts) as [keyof typeof parts, string][]) {
    const written = names[part];
    if (written === undefined) continue;
    (['left', 'right'] as const).forEach((side, i) =>
      pairs.push([`${side}_${ours}` as JointName, written.replace('*', names.sides[i]!)]),
    );
  }
  if (names.neck !== undefined) pairs.push(['neck', names.neck]);
  if (names.head !== undefined) pairs.push(['head', names.head]);
  return pairs;
}

/**
 * Largest distance in millimetres of a read joint from where it was made, over all frames and joints that have a name;
 * the floor is that of the first frame's knee.
 *
 * @param every frames of the made motion for each frame that was read
 */
export function worstMillimetres(
  file: LeaderFile,
  motion: Pick<MadeMotion, 'names' | 'joints' | 'places'>,
  every = 1,
): number {
  const index = new Map(motion.joints.map(({ name }, joint) => [name, joint]));
  const pairs = pairsOf(motion.names).map(([ours, name]) => [J[ours], index.get(name)!] as const);
  const read = (frame: number, joint: number): Vec3 =>
    readVec(file.clip.positions, frame * JOINT_COUNT + joint);
  const knee = pairs.find(([ours]) => ours === J.left_knee)!;
  const shift: Vec3 = [0, read(0, knee[0])[1] - motion.places[0]![knee[1]]![1], 0];
  let worst = 0;
  for (let frame = 0; frame < file.clip.frames; frame++)
    for (const [ours, made] of pairs)
      worst = Math.max(worst, distance(read(frame, ours), add(motion.places[frame * every]![made]!, shift)));
  return worst * 1000;
}

/** A vector of the made world in a file's unit and axes. */
export function inFile(v: Vec3, unitsPerMetre: number, up: 'y' | 'z'): Vec3 {
  const [x, y, z] = [v[0] * unitsPerMetre, v[1] * unitsPerMetre, v[2] * unitsPerMetre];
  return up === 'y' ? [x, y, z] : [x, -z, y];
}

/** All positions, frames x joints x 3, in a file's unit and axes, for the joints with these names in this order. */
export function positionsOf(
  motion: MadeMotion,
  names: readonly (string | null)[],
  unitsPerMetre = 1,
  up: 'y' | 'z' = 'y',
): Float32Array {
  const index = new Map(motion.joints.map(({ name }, joint) => [name, joint]));
  return Float32Array.from(
    motion.places.flatMap((places) =>
      names.flatMap((name) => inFile(name === null ? ZERO : places[index.get(name)!]!, unitsPerMetre, up)),
    ),
  );
}
