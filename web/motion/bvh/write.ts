import { BVH_NAMES } from './joint-names';
import type { SolvedMotion } from '../skeleton/clip';
import { eulerZxy } from '../math/euler';
import { readQuat } from '../math/quat';
import { CHILDREN, J, JOINT_COUNT, SMPL22 } from '../skeleton/skeleton';
import { readVec, scale, type Vec3, ZERO } from '../math/vec3';

/** Unit of the file: centimetres, as MotionBuilder and Maya assume; Blender's importer takes a scale of 0.01. */
const UNITS_PER_METRE = 100;
/** Four decimals: a micrometre, and an angle that moves the end of a limb by two micrometres. */
const DECIMALS = 4;
const DEGREES = 180 / Math.PI;

/** Bones beyond the last joints, metres: crown, finger knuckles and toe tips, so that tools draw those bones. */
const TIPS: ReadonlyMap<number, Vec3> = new Map([
  [J.head, [0, 0.18, 0]],
  [J.left_wrist, [0.09, 0, 0]],
  [J.right_wrist, [-0.09, 0, 0]],
  [J.left_foot, [0, 0, 0.06]],
  [J.right_foot, [0, 0, 0.06]],
]);

/** Joints in the order of the file: depth first. */
function depthFirst(joint: number): number[] {
  return [joint, ...CHILDREN[joint]!.flatMap(depthFirst)];
}

function decimal(value: number): string {
  const text = value.toFixed(DECIMALS);
  return Number(text) === 0 ? '0.0000' : text;
}

function triple(v: Vec3): string {
  return v.map(decimal).join(' ');
}

function hierarchy(offsets: Float32Array, joint: number, indent: string): string[] {
  const inner = `${indent}\t`;
  const head = joint === 0 ? 'ROOT' : 'JOINT';
  const position = joint === 0 ? '6 Xposition Yposition Zposition' : '3';
  const tip = TIPS.get(joint);
  const end =
    tip === undefined
      ? []
      : [
          `${inner}End Site`,
          `${inner}{`,
          `${inner}\tOFFSET ${triple(scale(tip, UNITS_PER_METRE))}`,
          `${inner}}`,
        ];
  return [
    `${indent}${head} ${BVH_NAMES[SMPL22[joint]!]}`,
    `${indent}{`,
    `${inner}OFFSET ${triple(joint === 0 ? ZERO : scale(readVec(offsets, joint), UNITS_PER_METRE))}`,
    `${inner}CHANNELS ${position} Zrotation Xrotation Yrotation`,
    ...CHILDREN[joint]!.flatMap((child) => hierarchy(offsets, child, inner)),
    ...end,
    `${indent}}`,
  ];
}

/**
 * A motion as the text of a BVH file.
 *
 * The rest pose is the solved skeleton's T-pose facing +z, y up, in centimetres; the root's offset is zero, so that
 * tools that add it to the root channels and tools that do not agree. Angles are degrees in the order Z X Y, unwrapped
 * over time. Lines end with a line feed.
 *
 * @throws RangeError when the motion has no frames
 */
export function writeBvh(motion: SolvedMotion): string {
  if (motion.frames < 1) throw new RangeError('A motion without frames cannot be written as BVH.');
  const order = depthFirst(0);
  const before: Vec3[] = new Array<Vec3>(JOINT_COUNT).fill(ZERO);
  const lines = [
    'HIERARCHY',
    ...hierarchy(motion.offsets, 0, ''),
    'MOTION',
    `Frames: ${motion.frames}`,
    `Frame Time: ${(1 / motion.fps).toFixed(8)}`,
  ];
  for (let frame = 0; frame < motion.frames; frame++) {
    const values = [triple(scale(readVec(motion.root, frame), UNITS_PER_METRE))];
    for (const joint of order) {
      const angles = eulerZxy(readQuat(motion.rotations, frame * JOINT_COUNT + joint), before[joint]!);
      before[joint] = angles;
      values.push(triple(scale(angles, DEGREES)));
    }
    lines.push(values.join(' '));
  }
  return lines.join('\n') + '\n';
}
