import type { BindPose } from './bind-pose';
import { forearm, hand, upperArm } from './arm';
import { buttock, foot, shin, thigh } from './leg';
import { pair, type Build, type Part, type BodyPlan, type Shape, type Side } from './part';
import { head, neck } from './head';
import { shoulderSlope, torso } from './trunk';

/** The body of a dancer in the bind pose. */
interface Anatomy {
  /** Shapes whose smooth union it is, in this order. */
  readonly shapes: readonly Shape[];
  /** The solids among them with skin weights. */
  readonly parts: readonly Part[];
}

/** Parts of both sides in the order of their union, and the blend width between left and right, metres. */
const LIMBS: readonly (readonly [make: (plan: BodyPlan, side: Side) => Part, between: number])[] = [
  [buttock, 0.03],
  [thigh, 0.006],
  [shin, 0.002],
  [foot, 0.002],
  [shoulderSlope, 0.05],
];
const ARMS: readonly ((plan: BodyPlan, side: Side) => Part[])[] = [
  (plan, side) => [upperArm(plan, side)],
  (plan, side) => [forearm(plan, side)],
  hand,
];

/** The solids of one body in the bind pose. */
export function anatomy(pose: BindPose, build: Build): Anatomy {
  const plan = { at: pose.joints, build };
  const shapes: Shape[] = [];
  const parts: Part[] = [];
  const single = (part: Part): void => {
    shapes.push(part);
    parts.push(part);
  };
  const both = (left: Part, right: Part, between: number): void => {
    shapes.push(pair(left, right, between));
    parts.push(left, right);
  };
  single(torso(plan));
  for (const [make, between] of LIMBS) both(make(plan, 1), make(plan, -1), between);
  single(neck(plan));
  single(head(plan));
  for (const make of ARMS) {
    const right = make(plan, -1);
    make(plan, 1).forEach((left, i) => both(left, right[i]!, 0.002));
  }
  return { shapes, parts };
}
