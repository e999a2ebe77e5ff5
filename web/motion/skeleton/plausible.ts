import type { MotionClip } from './clip';
import { J, JOINT_COUNT, SMPL22 } from './skeleton';
import { AppError } from '../../common/error';

/** Largest distance of a joint from the origin of the world, metres: a stage, and a recording that begins aside. */
const MAX_PLACE = 50;
/** Largest distance of a joint from the pelvis, metres: the raised hand of the tallest body that is read. */
const MAX_REACH = 3;

/**
 * Checks that every joint of every frame is where a dancer's joint can be: finite, near the origin and near the pelvis.
 *
 * @throws {AppError} `not-a-body`, naming the first frame and joint
 */
export function checkPlausible({ positions, frames }: MotionClip): void {
  for (let frame = 0; frame < frames; frame++) {
    const at = (joint: number, axis: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + axis]!;
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const [x, y, z] = [at(joint, 0), at(joint, 1), at(joint, 2)];
      const where = `${SMPL22[joint]!} in frame ${frame + 1}`;
      // Written so that a number that is not finite fails as well.
      if (!(Math.hypot(x, y, z) <= MAX_PLACE))
        throw implausible(`${where} is more than ${MAX_PLACE} m from the middle of the world`, frame === 0);
      const reach = Math.hypot(x - at(J.pelvis, 0), y - at(J.pelvis, 1), z - at(J.pelvis, 2));
      if (!(reach <= MAX_REACH)) throw implausible(`${where} is more than ${MAX_REACH} m from the pelvis`);
    }
  }
}

/** @param isAside whether the dance begins there, as in the scene of a game */
function implausible(where: string, isAside = false): AppError {
  return new AppError(
    'not-a-body',
    isAside ? `The dance is too far aside: ${where}.` : `No dancer moves like this: ${where}.`,
    isAside
      ? 'Move the dancer to the middle of the scene in the program it comes from, and export it again.'
      : 'Check the motion in the program it comes from, remove the wrong frames, and export it again.',
  );
}
