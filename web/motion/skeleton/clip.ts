/** Frames per second of every motion past the readers. */
export const FPS = 30;

/** Joint positions of one dancer, in the joint order of `skeleton.ts`. */
export interface MotionClip {
  /** Frames per second; `FPS` everywhere past the readers. */
  readonly fps: number;
  readonly frames: number;
  /** frames x 22 x 3, metres, y up, right-handed. */
  readonly positions: Float32Array;
}

/** A clip fitted to a skeleton with constant bone lengths, as it is drawn and exported. */
export interface SolvedMotion {
  readonly fps: number;
  readonly frames: number;
  /** 22 x 3 rest offsets from the parent in metres (root: 0); the rest pose is a T-pose facing +z. */
  readonly offsets: Float32Array;
  /** frames x 3, root position in metres. */
  readonly root: Float32Array;
  /** frames x 22 x 4, local rotations as quaternions xyzw, continuous over time. */
  readonly rotations: Float32Array;
  /** frames x 22 x 3, forward kinematics of the above in metres. */
  readonly positions: Float32Array;
  /** Mean distance between solved and given joints, metres. */
  readonly fitError: number;
}

/** The motion shifted level with the floor: by x and z metres in each frame. */
export function shiftedLevel(motion: SolvedMotion, x: Float64Array, z: Float64Array): SolvedMotion {
  return shifted(motion, (points, i, frame) => {
    points[i]! += x[frame]!;
    points[i + 2]! += z[frame]!;
  });
}

/** The motion brought down by so many metres in each frame. */
export function lowered(motion: SolvedMotion, down: Float64Array): SolvedMotion {
  return shifted(motion, (points, i, frame) => {
    points[i + 1]! -= down[frame]!;
  });
}

function shifted(
  motion: SolvedMotion,
  shift: (points: Float32Array, i: number, frame: number) => void,
): SolvedMotion {
  const all = (points: Float32Array): Float32Array => {
    const moved = points.slice();
    const row = points.length / motion.frames;
    for (let i = 0; i < moved.length; i += 3) shift(moved, i, Math.floor(i / row));
    return moved;
  };
  return { ...motion, root: all(motion.root), positions: all(motion.positions) };
}
