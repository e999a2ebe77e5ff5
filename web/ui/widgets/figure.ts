import { PARENTS, SMPL22 } from '../../motion/skeleton/skeleton';

/** Radius of the body at a joint, metres; a limb tapers from its parent joint's radius to its own. */
const BODY_RADIUS: Readonly<Record<string, number>> = {
  pelvis: 0.125,
  spine1: 0.125,
  spine2: 0.13,
  spine3: 0.135,
  neck: 0.052,
  left_hip: 0.095,
  right_hip: 0.095,
  left_knee: 0.06,
  right_knee: 0.06,
  left_ankle: 0.042,
  right_ankle: 0.042,
  left_foot: 0.032,
  right_foot: 0.032,
  left_collar: 0.075,
  right_collar: 0.075,
  left_shoulder: 0.062,
  right_shoulder: 0.062,
  left_elbow: 0.043,
  right_elbow: 0.043,
  left_wrist: 0.033,
  right_wrist: 0.033,
};
const HEAD = { radius: 0.1, above: 0.05 };
/** Height that the picture shows and how much of it is below the floor, metres. */
const VIEW_HEIGHT = 1.85;
const FLOOR_MARGIN = 0.08;

const joint = (name: string): number => SMPL22.findIndex((known) => known === name);
const [PELVIS, HEAD_JOINT] = [joint('pelvis'), joint('head')];

/** A limb of the figure: two ends in pixels with their radii, and its depth, larger is nearer. */
interface Limb {
  readonly ends: readonly [Dot, Dot];
  readonly depth: number;
}
interface Dot {
  readonly x: number;
  readonly y: number;
  readonly r: number;
}

/**
 * Draws one pose as a small figure that fills the canvas's height.
 * @param pose 22 x 3 joints, metres
 * @param heading turns the pose so that a dancer with this heading faces the viewer, a little to the side
 * @param colour CSS colour; farther limbs are darker
 */
export function drawFigure(
  context: CanvasRenderingContext2D,
  pose: Float32Array,
  heading: number,
  colour: string,
): void {
  const { width, height } = context.canvas;
  const scale = height / VIEW_HEIGHT;
  const angle = 0.45 - heading;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [ox, oz] = [pose[PELVIS * 3] ?? 0, pose[PELVIS * 3 + 2] ?? 0];
  const place = (index: number): { x: number; y: number; depth: number } => {
    const [x, y, z] = [0, 1, 2].map((axis) => pose[index * 3 + axis] ?? 0) as [number, number, number];
    const [dx, dz] = [x - ox, z - oz];
    return {
      x: width / 2 + (dx * cos + dz * sin) * scale,
      y: height - (y + FLOOR_MARGIN) * scale,
      depth: dz * cos - dx * sin,
    };
  };
  const limbs = PARENTS.flatMap((parent, child): Limb[] => {
    if (parent < 0 || child === HEAD_JOINT) return [];
    const [a, b] = [place(parent), place(child)];
    const radius = (index: number): number => (BODY_RADIUS[SMPL22[index] ?? ''] ?? 0.03) * scale;
    const thin = Math.min(radius(parent), radius(child) * 1.5);
    return [
      {
        ends: [
          { x: a.x, y: a.y, r: thin },
          { x: b.x, y: b.y, r: radius(child) },
        ],
        depth: (a.depth + b.depth) / 2,
      },
    ];
  });
  const head = place(HEAD_JOINT);
  const skull = { x: head.x, y: head.y - HEAD.above * scale, r: HEAD.radius * scale };
  limbs.push({
    ends: [{ ...skull, y: skull.y + 0.04 * scale, r: skull.r * 0.85 }, skull],
    depth: head.depth,
  });
  context.clearRect(0, 0, width, height);
  for (const { ends, depth } of limbs.sort((a, b) => a.depth - b.depth)) {
    const lit = Math.round(100 * Math.min(1, Math.max(0.62, 0.88 + depth * 0.8)));
    context.fillStyle = `color-mix(in srgb, ${colour} ${lit}%, black)`;
    capsule(context, ends);
  }
}

/** A limb with round ends that may differ in thickness. */
function capsule(context: CanvasRenderingContext2D, [a, b]: readonly [Dot, Dot]): void {
  const direction = Math.atan2(b.y - a.y, b.x - a.x);
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  const lean = length > Math.abs(a.r - b.r) ? Math.acos((a.r - b.r) / length) : 0;
  context.beginPath();
  if (lean > 0) {
    context.arc(a.x, a.y, a.r, direction + lean, direction - lean + 2 * Math.PI);
    context.arc(b.x, b.y, b.r, direction - lean, direction + lean);
    context.closePath();
  } else {
    const large = a.r > b.r ? a : b;
    context.arc(large.x, large.y, large.r, 0, 2 * Math.PI);
  }
  context.fill();
}
