import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { solve } from '../../../../web/motion/fit/ik';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { person } from '../skeletons';

export interface WalkOptions {
  readonly seconds: number;
  /** Turns a second about the vertical. */
  readonly turn: number;
  /** Metres to walk away from the middle and back again, along -z, in the time. */
  readonly distance: number;
}

/** Seconds of a step, share of it in which the foot swings, and how high it is lifted, metres. */
const STEP = 0.5;
const SWING = 0.8;
const LIFT = 0.1;
const FPS = 30;
const THIGH = 0.41;
const SHIN = 0.415;
const ANKLE_HEIGHT = 0.085;
const HIP_HEIGHT = 0.86;

interface Place {
  readonly x: number;
  readonly z: number;
  /** Radians about y; 0 looks to +z. */
  readonly heading: number;
}

/**
 * A person who steps on the spot, turns, or walks away and back: feet stand without sliding, each step's foot swings to
 * where the body will be, knees bend, arms swing. At 30 fps on the body of `person`.
 */
export function walker({ seconds, turn, distance }: WalkOptions): SolvedMotion {
  const frames = Math.round(seconds * FPS);
  const place = (time: number): Place => {
    const phase = (2 * Math.PI * time) / seconds;
    // Half a turn at the far end takes a second and a half.
    const half = Math.min(1, Math.max(0, (time - seconds / 2 + 0.75) / 1.5));
    const walkHeading = distance > 0 ? Math.PI * (1 - half) : 0;
    return {
      x: 0,
      z: (-distance * (1 - Math.cos(phase))) / 2,
      heading: walkHeading + 2 * Math.PI * turn * time,
    };
  };
  const positions = new Float32Array(frames * JOINT_COUNT * 3);
  for (let frame = 0; frame < frames; frame++) {
    const time = frame / FPS;
    const row = positions.subarray(frame * JOINT_COUNT * 3, (frame + 1) * JOINT_COUNT * 3);
    poseAt(row, time, place);
  }
  return solve({ fps: FPS, frames, positions });
}

/** Where a foot stands in the floor's plane, and how high its ankle is. Left feet step at even steps. */
function foot(time: number, side: 1 | -1, place: (time: number) => Place): Place & { lift: number } {
  const offset = side === 1 ? 0 : STEP;
  const cycle = Math.floor((time - offset) / (2 * STEP));
  const into = time - offset - cycle * 2 * STEP;
  // It swings in its own step and stands in the other one, where the body is in the middle of the stance.
  const standing = (n: number): Place => {
    const body = place(offset + (n + 1) * 2 * STEP - STEP / 2);
    const [cos, sin] = [Math.cos(body.heading), Math.sin(body.heading)];
    return { x: body.x + side * 0.1 * cos, z: body.z - side * 0.1 * sin, heading: body.heading };
  };
  const swing = Math.min(1, Math.max(0, into / (STEP * SWING)));
  const ease = swing * swing * (3 - 2 * swing);
  const [from, to] = [standing(cycle - 1), standing(cycle)];
  return {
    x: from.x + (to.x - from.x) * ease,
    z: from.z + (to.z - from.z) * ease,
    heading: from.heading + (to.heading - from.heading) * ease,
    lift: LIFT * Math.sin(Math.PI * swing) ** 2,
  };
}

function poseAt(row: Float32Array, time: number, place: (time: number) => Place): void {
  const offsets = person();
  const body = place(time);
  const [cos, sin] = [Math.cos(body.heading), Math.sin(body.heading)];
  const put = (joint: number, x: number, y: number, z: number): void => row.set([x, y, z], 3 * joint);
  /** From the body's own axes, across and ahead, to the world. */
  const turned = (across: number, ahead: number): [number, number] => [
    across * cos + ahead * sin,
    -across * sin + ahead * cos,
  ];
  const offset = (joint: number): [number, number, number] => [
    offsets[3 * joint]!,
    offsets[3 * joint + 1]!,
    offsets[3 * joint + 2]!,
  ];
  const from = (joint: number, parent: number): void => {
    const [x, y, z] = offset(joint);
    const [dx, dz] = turned(x, z);
    put(joint, row[3 * parent]! + dx, row[3 * parent + 1]! + y, row[3 * parent + 2]! + dz);
  };
  put(J.pelvis, body.x, HIP_HEIGHT + 0.1, body.z);
  for (const [joint, parent] of [
    [J.left_hip, J.pelvis],
    [J.right_hip, J.pelvis],
    [J.spine1, J.pelvis],
    [J.spine2, J.spine1],
    [J.spine3, J.spine2],
    [J.neck, J.spine3],
    [J.head, J.neck],
    [J.left_collar, J.spine3],
    [J.right_collar, J.spine3],
    [J.left_shoulder, J.left_collar],
    [J.right_shoulder, J.right_collar],
  ] as const)
    from(joint, parent);
  for (const side of [1, -1] as const) {
    const [hip, knee, ankle, toe, shoulder, elbow, wrist] =
      side === 1
        ? [J.left_hip, J.left_knee, J.left_ankle, J.left_foot, J.left_shoulder, J.left_elbow, J.left_wrist]
        : [
            J.right_hip,
            J.right_knee,
            J.right_ankle,
            J.right_foot,
            J.right_shoulder,
            J.right_elbow,
            J.right_wrist,
          ];
    const step = foot(time, side, place);
    put(ankle, step.x, ANKLE_HEIGHT + step.lift, step.z);
    put(
      toe,
      step.x + 0.11 * Math.sin(step.heading),
      0.03 + step.lift,
      step.z + 0.11 * Math.cos(step.heading),
    );
    bendKnee(row, hip, knee, ankle, turned(0, 1));
    // The arm swings against the leg, with a bent elbow.
    const swing = side * 0.5 * Math.sin((Math.PI * time) / STEP);
    const [ux, uz] = turned(side * 0.08, 0.274 * Math.sin(swing));
    put(
      elbow,
      row[3 * shoulder]! + ux,
      row[3 * shoulder + 1]! - 0.26 * Math.cos(swing),
      row[3 * shoulder + 2]! + uz,
    );
    const [fx, fz] = turned(0, 0.197 * Math.sin(swing + 1));
    put(
      wrist,
      row[3 * elbow]! + fx,
      row[3 * elbow + 1]! - 0.197 * Math.cos(swing + 1),
      row[3 * elbow + 2]! + fz,
    );
  }
}

/** Places the knee between hip and ankle, bent ahead. */
function bendKnee(
  row: Float32Array,
  hip: number,
  knee: number,
  ankle: number,
  [aheadX, aheadZ]: readonly [number, number],
): void {
  const line = [0, 1, 2].map((axis) => row[3 * ankle + axis]! - row[3 * hip + axis]!);
  const span = Math.min(Math.hypot(...line), 0.999 * (THIGH + SHIN));
  const along = (span * span + THIGH * THIGH - SHIN * SHIN) / (2 * span);
  const aside = Math.sqrt(Math.max(0, THIGH * THIGH - along * along));
  const unit = line.map((value) => value / Math.hypot(...line));
  const towards = [aheadX, 0, aheadZ];
  const dot = towards.reduce((sum, value, axis) => sum + value * unit[axis]!, 0);
  const square = towards.map((value, axis) => value - dot * unit[axis]!);
  const size = Math.hypot(...square);
  for (let axis = 0; axis < 3; axis++)
    row[3 * knee + axis] = row[3 * hip + axis]! + unit[axis]! * along + (square[axis]! / size) * aside;
}
