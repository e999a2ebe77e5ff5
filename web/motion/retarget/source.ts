import type { AxisName, Unit } from './axes-and-units';

/** A joint of a file. Parents come before their children. */
export interface SourceJoint {
  /** Name as written. */
  readonly name: string;
  /** Index of the parent, -1 for a joint that hangs on nothing. */
  readonly parent: number;
  /** A tip that has no motion of its own, as an end site of BVH. */
  readonly endSite?: boolean | undefined;
}

/** Transforms of all joints from their parents, in some frames. */
export interface LocalPoses {
  /** frames x joints x 4, xyzw. */
  readonly rotations: Float32Array;
  /** frames x joints x 3, in the file's unit. */
  readonly translations: Float32Array;
}

/**
 * What every reader makes of a motion file: a hierarchy of named joints that moves, in the file's own unit and axes.
 *
 * In files that hold positions alone no joint turns: their rotations stay the identity.
 */
export interface MotionSource {
  /** Name of the format as the visitor knows it. */
  readonly format: string;
  readonly joints: readonly SourceJoint[];
  /** What the skeleton is called, where the joints were made here and their names do not tell. */
  readonly convention?: string;
  /** The pose without any motion, as one frame. */
  readonly rest: LocalPoses;
  readonly frames: number;
  /**
   * Frames per second as the file states them.
   * @throws {AppError} `bad-frame-time`
   */
  readonly frameRate: () => number;
  /** Whether the file states no frame rate, so that `frameRate` is the usual one of the format. */
  readonly rateAssumed: boolean;
  /** The unit that the format or the file states; null where it must be inferred from the body. */
  readonly unit: Unit | null;
  /** The up axis that the format or the file states, used where the body does not tell. */
  readonly upAxis: AxisName | null;
  /** Names of the dancers or clips in the file, one of which was read, and the number of that one. */
  readonly parts: readonly string[];
  readonly part: number;
  /** Sentences about what was left out. */
  readonly warnings: readonly string[];
  /** Whether the file ends before its last frame is complete. */
  readonly truncated: boolean;
  /** Poses in chosen frames (0 to `frames` - 1). */
  readonly localPoses: (frames: readonly number[]) => LocalPoses;
}

/** The source without its first frames. */
export function withoutFirst(source: MotionSource, count: number): MotionSource {
  if (count === 0) return source;
  const { frames, localPoses } = source;
  return {
    ...source,
    frames: frames - count,
    localPoses: (wanted) => localPoses(wanted.map((frame) => frame + count)),
  };
}

/** Poses of a joint tree that never moves: every rotation is the identity. */
export function restOf(translations: Float32Array): LocalPoses {
  const rotations = new Float32Array((translations.length / 3) * 4);
  for (let at = 3; at < rotations.length; at += 4) rotations[at] = 1;
  return { rotations, translations };
}
