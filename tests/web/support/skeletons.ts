import { JOINT_COUNT, PARENTS } from '../../../web/motion/skeleton/skeleton';
import type { SolvedMotion } from '../../../web/motion/skeleton/clip';

const HALF: readonly (readonly [number, number, number])[] = [
  [0, 0, 0],
  [0.083, -0.1, 0.017],
  [-0.083, -0.1, 0.017],
  [0, 0.116, 0.017],
  [0, -0.41, 0],
  [0, -0.41, 0],
  [0, 0.117, 0],
  [0, -0.415, 0],
  [0, -0.415, 0],
  [0, 0.058, 0],
  [0, -0.04, 0.09],
  [0, -0.04, 0.09],
  [0, 0.153, 0],
  [0.078, 0.075, 0.016],
  [-0.078, 0.075, 0.016],
  [0, 0.095, 0],
  [0.145, 0.03, 0.02],
  [-0.145, 0.03, 0.02],
  [0.274, 0, 0],
  [-0.274, 0, 0],
  [0.197, 0, 0],
  [-0.197, 0, 0],
];

/** Rest offsets (22 x 3, metres) of a symmetric person, `scale` times the ordinary height. */
export const person = (scale = 1): Float32Array => Float32Array.from(HALF.flat(), (value) => value * scale);

/** A seeded generator of numbers from -1 to 1. */
export function noise(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return (state / 2 ** 32) * 2 - 1;
  };
}

type Quat = readonly [number, number, number, number];

function times([ax, ay, az, aw]: Quat, [bx, by, bz, bw]: Quat): Quat {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

function rotate([x, y, z, w]: Quat, v: readonly number[]): number[] {
  const [vx, vy, vz] = [v[0]!, v[1]!, v[2]!];
  const [tx, ty, tz] = [2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)];
  return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

/** A motion of random turns whose positions come from forward kinematics written out here. */
export function randomMotion(frames: number, seed = 1, offsets = person()): SolvedMotion {
  const next = noise(seed);
  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4);
  const positions = new Float32Array(frames * JOINT_COUNT * 3);
  for (let frame = 0; frame < frames; frame++) {
    root.set([next(), 0.9 + 0.1 * next(), next()], frame * 3);
    const world: Quat[] = [];
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const raw = [next(), next(), next(), 2 + next()];
      const norm = Math.hypot(...raw);
      const local = raw.map((value) => Math.fround(value / norm)) as unknown as Quat;
      rotations.set(local, (frame * JOINT_COUNT + joint) * 4);
      const parent = PARENTS[joint]!;
      const at = (frame * JOINT_COUNT + joint) * 3;
      if (parent < 0) {
        world.push(local);
        positions.set(root.subarray(frame * 3, frame * 3 + 3), at);
        continue;
      }
      const turned = rotate(world[parent]!, [...offsets.subarray(joint * 3, joint * 3 + 3)]);
      const from = (frame * JOINT_COUNT + parent) * 3;
      for (let axis = 0; axis < 3; axis++) positions[at + axis] = positions[from + axis]! + turned[axis]!;
      world.push(times(world[parent]!, local));
    }
  }
  return { fps: 30, frames, offsets, root, rotations, positions, fitError: 0 };
}
