import type { Inspection } from '../../../motion/import/inspect';
import { type AxisName, UP_AXES } from '../../../motion/retarget/axes-and-units';
import { rotate } from '../../../motion/math/quat';
import { direction, dot, readVec, sub, X_AXIS } from '../../../motion/math/vec3';

const MARGIN = 16;

/**
 * Draws the joints of a file from the front: bones as lines, joints that stand for one of the 22 as dots in the leader's
 * colour, the one under the hand larger.
 *
 * @param mapped indices of the joints that stand for one of the 22
 * @param marked index of the joint that is being chosen, or null
 */
export function drawSkeleton(
  canvas: HTMLCanvasElement,
  { joints, places, found }: Inspection,
  up: AxisName,
  mapped: ReadonlySet<number>,
  marked: number | null,
): void {
  const context = canvas.getContext('2d');
  if (!context) return;
  const { turn } = UP_AXES.find(({ name }) => name === up)!;
  const upright = joints.map((_, joint) => rotate(turn, readVec(places, joint)));
  // Seen from the front: the way from the right hip to the left one goes to the right.
  const [leftHip, rightHip] = [found.left_hip, found.right_hip].map((joint) => upright[joint ?? -1]);
  const across = leftHip && rightHip ? sub(leftHip, rightHip) : X_AXIS;
  const level = direction([across[0], 0, across[2]], X_AXIS);
  const points = upright.map((place) => ({ x: dot(place, level), y: -place[1] }));
  // Props and roots far from the body would make it small.
  const shown = points.filter((_, joint) => mapped.size === 0 || mapped.has(joint));
  const [left, top] = [Math.min(...shown.map(({ x }) => x)), Math.min(...shown.map(({ y }) => y))];
  const width = Math.max(...shown.map(({ x }) => x)) - left;
  const height = Math.max(...shown.map(({ y }) => y)) - top;
  const room = [canvas.width - 2 * MARGIN, canvas.height - 2 * MARGIN] as const;
  const scale = Math.min(room[0] / Math.max(width, 1e-6), room[1] / Math.max(height, 1e-6));
  const at = (joint: number): [number, number] => [
    canvas.width / 2 + (points[joint]!.x - left - width / 2) * scale,
    canvas.height / 2 + (points[joint]!.y - top - height / 2) * scale,
  ];
  const style = getComputedStyle(canvas);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.lineWidth = 2;
  context.strokeStyle = style.getPropertyValue('--text-3') || 'gray';
  context.globalAlpha = 0.6;
  // A root on which a single joint hangs is a place on the floor; others are hips.
  const children = new Map<number, number>();
  for (const { parent } of joints) children.set(parent, (children.get(parent) ?? 0) + 1);
  joints.forEach(({ parent }, joint) => {
    if (parent < 0 || (joints[parent]!.parent < 0 && children.get(parent) === 1)) return;
    context.beginPath();
    context.moveTo(...at(parent));
    context.lineTo(...at(joint));
    context.stroke();
  });
  context.globalAlpha = 1;
  context.fillStyle = style.getPropertyValue('--leader') || 'steelblue';
  for (const joint of mapped) {
    context.beginPath();
    context.arc(...at(joint), joint === marked ? 9 : 4.5, 0, 2 * Math.PI);
    context.fill();
  }
}
