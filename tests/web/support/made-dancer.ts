import type { MotionClip, SolvedMotion } from '../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../web/motion/skeleton/kinematics';
import { aboutAxis, multiply, type Quat, writeQuat } from '../../../web/motion/math/quat';
import { J, JOINT_COUNT } from '../../../web/motion/skeleton/skeleton';
import type { Vec3 } from '../../../web/motion/math/vec3';

/** Numbers in [0, 1) that are the same in every run (mulberry32). */
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Joint offsets (metres) of a symmetric body in the rest pose of the solver: T-pose facing +z. */
export const BODY: Readonly<Record<number, Vec3>> = {
  [J.left_hip]: [0.085, -0.09, 0],
  [J.right_hip]: [-0.085, -0.09, 0],
  [J.spine1]: [0, 0.115, 0],
  [J.left_knee]: [0, -0.42, 0],
  [J.right_knee]: [0, -0.42, 0],
  [J.spine2]: [0, 0.12, 0],
  [J.left_ankle]: [0, -0.41, 0],
  [J.right_ankle]: [0, -0.41, 0],
  [J.spine3]: [0, 0.06, 0],
  [J.left_foot]: [0, -0.04, 0.1],
  [J.right_foot]: [0, -0.04, 0.1],
  [J.neck]: [0, 0.16, 0],
  [J.left_collar]: [0.075, 0.08, 0.01],
  [J.right_collar]: [-0.075, 0.08, 0.01],
  [J.head]: [0, 0.1, 0],
  [J.left_shoulder]: [0.13, 0.01, -0.01],
  [J.right_shoulder]: [-0.13, 0.01, -0.01],
  [J.left_elbow]: [0.27, 0, 0],
  [J.right_elbow]: [-0.27, 0, 0],
  [J.left_wrist]: [0.24, 0, 0],
  [J.right_wrist]: [-0.24, 0, 0],
};

/** Largest swing of each joint to either side, degrees; hinges are handled apart. */
const SWINGS: Readonly<Record<number, number>> = {
  [J.left_hip]: 40,
  [J.right_hip]: 40,
  [J.spine1]: 10,
  [J.spine2]: 10,
  [J.spine3]: 10,
  [J.left_ankle]: 20,
  [J.right_ankle]: 20,
  [J.neck]: 20,
  [J.left_collar]: 8,
  [J.right_collar]: 8,
  [J.left_shoulder]: 50,
  [J.right_shoulder]: 50,
};
const HINGES: readonly (readonly [number, Vec3])[] = [
  [J.left_knee, [1, 0, 0]],
  [J.right_knee, [1, 0, 0]],
  [J.left_elbow, [0, -1, 0]],
  [J.right_elbow, [0, 1, 0]],
];

export interface DancerOptions {
  readonly frames: number;
  readonly seed?: number;
  /** Turns per second about the vertical. */
  readonly spin?: number;
  /** Bend of knees and elbows over time, radians; default 10 to 80 degrees. */
  readonly bend?: (joint: number, seconds: number) => number;
  readonly size?: number;
}

function offsetsOf(size: number): Float32Array {
  const offsets = new Float32Array(JOINT_COUNT * 3);
  for (const [joint, offset] of Object.entries(BODY)) {
    offsets.set(
      offset.map((value) => value * size),
      3 * Number(joint),
    );
  }
  return offsets;
}

/** A synthetic dance: a sine on every joint angle, a path over the floor, constant bone lengths. */
export function madeDancer(options: DancerOptions): SolvedMotion {
  const { frames, seed = 1, spin = 0, size = 1 } = options;
  const draw = random(seed);
  const wave = (degrees: number): ((seconds: number) => number) => {
    const [pace, phase] = [0.3 + 0.9 * draw(), 2 * Math.PI * draw()];
    return (seconds) => ((degrees * Math.PI) / 180) * Math.sin(2 * Math.PI * pace * seconds + phase);
  };
  const swings = Object.entries(SWINGS).map(([joint, degrees]) => ({
    joint: Number(joint),
    waves: [wave(degrees), wave(degrees), wave(degrees / 4)] as const,
  }));
  const bends = HINGES.map(([joint, axis]) => {
    const own = wave(35);
    const bend = options.bend ?? ((_: number, seconds: number) => Math.PI / 4 + own(seconds));
    return { joint, axis, angle: (seconds: number) => bend(joint, seconds) };
  });
  const path = [wave(30), wave(30)] as const;
  const offsets = offsetsOf(size);
  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4);
  for (let frame = 0; frame < frames; frame++) {
    const seconds = frame / 30;
    root.set([path[0](seconds), 0.95 * size + 0.02 * Math.sin(5 * seconds), path[1](seconds)], 3 * frame);
    const put = (joint: number, q: Quat): void => writeQuat(rotations, frame * JOINT_COUNT + joint, q);
    for (let joint = 0; joint < JOINT_COUNT; joint++) put(joint, [0, 0, 0, 1]);
    put(J.pelvis, aboutAxis([0, 1, 0], 2 * Math.PI * spin * seconds));
    for (const { joint, waves } of swings) {
      const [x, y, z] = waves.map((one) => one(seconds)) as [number, number, number];
      put(
        joint,
        multiply(aboutAxis([0, 0, 1], x), multiply(aboutAxis([1, 0, 0], y), aboutAxis([0, 1, 0], z))),
      );
    }
    for (const { joint, axis, angle } of bends) put(joint, aboutAxis(axis, angle(seconds)));
  }
  const positions = forwardKinematics(offsets, root, rotations);
  return { fps: 30, frames, offsets, root, rotations, positions, fitError: 0 };
}

/** Adds Gaussian noise to every coordinate; `deviation` in metres. */
export function noisy(positions: Float32Array, deviation: number, seed = 7): Float32Array {
  const draw = random(seed);
  return positions.map(
    (value) => value + deviation * Math.sqrt(-2 * Math.log(draw() + 1e-12)) * Math.cos(2 * Math.PI * draw()),
  );
}

/** The clip with every coordinate multiplied by `factor`: body and path over the floor alike. */
export function scaled(clip: MotionClip, factor: number): MotionClip {
  return { ...clip, positions: clip.positions.map((value) => value * factor) };
}
