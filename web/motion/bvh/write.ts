import { BVH_NAMES } from './names';
import type { SolvedMotion } from '../skeleton/clip';
import { eulerZxy } from '../math/euler';
import { readQuat } from '../math/quat';
import { CROWN, restRoot } from '../skeleton/kinematics';
import { CHILDREN, J, JOINT_COUNT, SMPL22 } from '../skeleton/skeleton';
import { readVec, scale, type Vec3, ZERO } from '../math/vec3';

/** Unit of the file: centimetres, as MotionBuilder and Maya assume; Blender's importer takes a scale of 0.01. */
const UNITS_PER_METRE = 100;
/** Four decimals: a micrometre, and an angle that moves the end of a limb by two micrometres. */
const DECIMALS = 4;
const DEGREES_PER_RADIAN = 180 / Math.PI;

/** Offsets of the end sites from the last joints, metres: crown, finger knuckles and tips of the toes. */
const END_SITES: ReadonlyMap<number, Vec3> = new Map([
  [J.head, [0, CROWN, 0]],
  [J.left_wrist, [0.09, 0, 0]],
  [J.right_wrist, [-0.09, 0, 0]],
  [J.left_foot, [0, 0, 0.06]],
  [J.right_foot, [0, 0, 0.06]],
]);

/** Joints in the order of the file: depth first. */
function depthFirst(joint: number): number[] {
  return [joint, ...CHILDREN[joint]!.flatMap(depthFirst)];
}

function formatNumber(value: number): string {
  const text = value.toFixed(DECIMALS);
  return Number(text) === 0 ? '0.0000' : text;
}

function formatVec(v: Vec3): string {
  return v.map(formatNumber).join(' ');
}

/** The lines of a joint and everything below it. */
function hierarchy(motion: SolvedMotion, joint: number, indent: string): string[] {
  const childIndent = `${indent}\t`;
  const head = joint === 0 ? 'ROOT' : 'JOINT';
  const position = joint === 0 ? '6 Xposition Yposition Zposition' : '3';
  const endSite = END_SITES.get(joint);
  const end =
    endSite === undefined
      ? []
      : [
          `${childIndent}End Site`,
          `${childIndent}{`,
          `${childIndent}\tOFFSET ${formatVec(scale(endSite, UNITS_PER_METRE))}`,
          `${childIndent}}`,
        ];
  return [
    `${indent}${head} ${BVH_NAMES[SMPL22[joint]!]}`,
    `${indent}{`,
    `${childIndent}OFFSET ${formatVec(scale(joint === 0 ? restRoot(motion) : readVec(motion.offsets, joint), UNITS_PER_METRE))}`,
    `${childIndent}CHANNELS ${position} Zrotation Xrotation Yrotation`,
    ...CHILDREN[joint]!.flatMap((child) => hierarchy(motion, child, childIndent)),
    ...end,
    `${indent}}`,
  ];
}

/**
 * A motion as the text of a BVH file.
 *
 * The rest pose is the solved skeleton's T-pose facing +z, y up, in centimetres, standing on the floor where the dance
 * begins, as in GLB. The root's position channels are its place itself, as Blender, MotionBuilder and Maya take them, not
 * what is added to its offset. Angles are degrees in the order Z X Y, unwrapped
 * over time. Lines end with a line feed.
 *
 * @throws RangeError when the motion has no frames
 */
export function writeBvh(motion: SolvedMotion): string {
  if (motion.frames < 1) throw new RangeError('A motion without frames cannot be written as BVH.');
  const order = depthFirst(0);
  const previous: Vec3[] = new Array<Vec3>(JOINT_COUNT).fill(ZERO);
  const lines = [
    'HIERARCHY',
    ...hierarchy(motion, 0, ''),
    'MOTION',
    `Frames: ${motion.frames}`,
    `Frame Time: ${(1 / motion.fps).toFixed(8)}`,
  ];
  for (let frame = 0; frame < motion.frames; frame++) {
    const values = [formatVec(scale(readVec(motion.root, frame), UNITS_PER_METRE))];
    for (const joint of order) {
      const angles = eulerZxy(readQuat(motion.rotations, frame * JOINT_COUNT + joint), previous[joint]!);
      previous[joint] = angles;
      values.push(formatVec(scale(angles, DEGREES_PER_RADIAN)));
    }
    lines.push(values.join(' '));
  }
  return lines.join('\n') + '\n';
}
