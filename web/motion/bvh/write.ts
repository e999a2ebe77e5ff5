import { BVH_NAMES, REFERENCE } from './names';
import type { SolvedMotion } from '../skeleton/clip';
import { eulerZxy } from '../math/euler';
import { readQuat } from '../math/quat';
import { CROWN, restRootHeight } from '../skeleton/kinematics';
import { CHILDREN, J, JOINT_COUNT, SMPL22 } from '../skeleton/skeleton';
import { readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

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

const ROTATIONS = 'Zrotation Xrotation Yrotation';

/** The lines of a joint and everything below it. */
function hierarchy(motion: SolvedMotion, joint: number, indent: string): string[] {
  const childIndent = `${indent}\t`;
  const offset = joint === 0 ? restHips(motion) : readVec(motion.offsets, joint);
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
    `${indent}JOINT ${BVH_NAMES[SMPL22[joint]!]}`,
    `${indent}{`,
    `${childIndent}OFFSET ${formatVec(scale(offset, UNITS_PER_METRE))}`,
    `${childIndent}CHANNELS 3 ${ROTATIONS}`,
    ...CHILDREN[joint]!.flatMap((child) => hierarchy(motion, child, childIndent)),
    ...end,
    `${indent}}`,
  ];
}

/** The hips above the reference in the rest pose, metres. */
function restHips({ offsets }: SolvedMotion): Vec3 {
  return [0, restRootHeight(offsets), 0];
}

/**
 * A motion as the text of a BVH file.
 *
 * The rest pose is the solved skeleton's T-pose facing +z, y up, in centimetres, standing on the floor, as in GLB. The
 * root is a reference point below the hips, at the origin in the rest pose; it moves without turning. Programs disagree
 * whether a root's position channels are its place (Blender) or are added to its OFFSET (three.js): with an OFFSET of 0
 * both are the same. Angles are degrees in the order Z X Y, unwrapped over time. Lines end with a line feed.
 *
 * @throws RangeError when the motion has no frames
 */
export function writeBvh(motion: SolvedMotion): string {
  if (motion.frames < 1) throw new RangeError('A motion without frames cannot be written as BVH.');
  const order = depthFirst(0);
  const hips = restHips(motion);
  const previous: Vec3[] = new Array<Vec3>(JOINT_COUNT).fill(ZERO);
  const lines = [
    'HIERARCHY',
    `ROOT ${REFERENCE}`,
    '{',
    `\tOFFSET ${formatVec(ZERO)}`,
    `\tCHANNELS 6 Xposition Yposition Zposition ${ROTATIONS}`,
    ...hierarchy(motion, 0, '\t'),
    '}',
    'MOTION',
    `Frames: ${motion.frames}`,
    `Frame Time: ${(1 / motion.fps).toFixed(8)}`,
  ];
  for (let frame = 0; frame < motion.frames; frame++) {
    const reference = sub(readVec(motion.root, frame), hips);
    const values = [formatVec(scale(reference, UNITS_PER_METRE)), formatVec(ZERO)];
    for (const joint of order) {
      const angles = eulerZxy(readQuat(motion.rotations, frame * JOINT_COUNT + joint), previous[joint]!);
      previous[joint] = angles;
      values.push(formatVec(scale(angles, DEGREES_PER_RADIAN)));
    }
    lines.push(values.join(' '));
  }
  return lines.join('\n') + '\n';
}
