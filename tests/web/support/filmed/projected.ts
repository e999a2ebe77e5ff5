import type { MotionClip } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import type { Observations } from '../../../../web/video/observations';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';
import { L, OTHER_SIDE } from '../../../../web/video/pose/landmark-names';
import { noise } from '../skeletons';

/** A camera that stands still and looks along -z, pitched down by radians. */
export interface Camera {
  readonly width: number;
  readonly height: number;
  /** Pixels. */
  readonly focal: number;
  readonly position: readonly [number, number, number];
  readonly pitch: number;
}

/** The joint at each landmark. */
const SOURCES: readonly (readonly [landmark: number, joint: number])[] = (['left', 'right'] as const).flatMap(
  (side) =>
    [
      [L[`${side}_ear`], J.head],
      [L[`${side}_shoulder`], J[`${side}_shoulder`]],
      [L[`${side}_elbow`], J[`${side}_elbow`]],
      [L[`${side}_wrist`], J[`${side}_wrist`]],
      [L[`${side}_hip`], J[`${side}_hip`]],
      [L[`${side}_knee`], J[`${side}_knee`]],
      [L[`${side}_ankle`], J[`${side}_ankle`]],
      [L[`${side}_heel`], J[`${side}_ankle`]],
      [L[`${side}_toe`], J[`${side}_foot`]],
    ] as [number, number][],
);

/**
 * What a camera would see of a motion with a network that errs by `deviation` metres at each landmark.
 * @param flip frames in which it takes the back for the front
 */
export function projected(
  clip: MotionClip,
  { width, height, focal, position, pitch }: Camera,
  deviation: number,
  flip = { from: 0, to: 0 },
): Observations {
  const { frames, positions } = clip;
  const draw = noise(3);
  const image = new Float32Array(frames * LANDMARK_COUNT * 2);
  const world = new Float32Array(frames * LANDMARK_COUNT * 3);
  const [cos, sin] = [Math.cos(pitch), Math.sin(pitch)];
  const inCamera = (frame: number, joint: number): [number, number, number] => {
    const at = 3 * (frame * JOINT_COUNT + joint);
    const [x, y, z] = [0, 1, 2].map((axis) => positions[at + axis]! - position[axis]!) as [
      number,
      number,
      number,
    ];
    return [x, -y * cos + z * sin, -z * cos - y * sin];
  };
  for (let frame = 0; frame < frames; frame++) {
    const [left, right] = [inCamera(frame, J.left_hip), inCamera(frame, J.right_hip)];
    const flipped = frame >= flip.from && frame < flip.to;
    for (const [landmark, joint] of SOURCES) {
      const seen = inCamera(frame, joint).map((value) => value + deviation * draw());
      const row = frame * LANDMARK_COUNT + (flipped ? OTHER_SIDE[landmark]! : landmark);
      image.set(
        [(focal * seen[0]!) / seen[2]! + width / 2, (focal * seen[1]!) / seen[2]! + height / 2],
        2 * row,
      );
      const relative = seen.map((value, axis) => value - (left[axis]! + right[axis]!) / 2);
      if (flipped) relative[2]! *= -1;
      world.set(relative, 3 * row);
    }
  }
  return {
    width,
    height,
    times: Float64Array.from({ length: frames }, (_, frame) => frame / 30),
    presence: new Float32Array(frames).fill(1),
    image,
    world,
    visibility: new Float32Array(frames * LANDMARK_COUNT).fill(0.95),
    // The whole picture was seen, so that the axes are the camera's.
    centre: Float32Array.from({ length: 2 * frames }, (_, i) => (i % 2 === 0 ? width : height) / 2),
    turn: Float32Array.from({ length: 4 * frames }, (_, i) => Number(i % 4 === 3)),
    cuts: [],
    brightest: 1,
  };
}
