/** Joint positions of one dancer, in the joint order of `skeleton.ts`. */
export interface MotionClip {
  /** Frames per second; 30 everywhere past the readers. */
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
