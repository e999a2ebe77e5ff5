import type { MotionClip } from './clip';
import { J, JOINT_COUNT, SMPL22 } from './skeleton';
import { AppError } from '../../common/error';

/** Largest distance of a joint from the origin of the world, metres: a stage, and a recording that begins aside. */
const MAX_PLACE = 50;
/** Largest distance of a joint from the pelvis, metres: the raised hand of the tallest body that is read. */
const MAX_REACH = 3;

const HINT_FRAMES =
  'Check the motion in the program it comes from, remove the wrong frames, and export it again.';
const HINT_ASIDE =
  'Move the dancer to the middle of the scene in the program it comes from, and export it again.';

const notABody = (message: string, hint: string): AppError => new AppError('not-a-body', message, hint);

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
      if (!Number.isFinite(x + y + z))
        throw notABody(`A joint has no place: a coordinate of ${where} is not a finite number.`, HINT_FRAMES);
      if (Math.hypot(x, y, z) > MAX_PLACE) {
        const away = `${where} is more than ${MAX_PLACE} m from the middle of the world`;
        // In the first frame the whole dance is there, as in the scene of a game.
        throw frame === 0
          ? notABody(`The dance is too far aside: ${away}.`, HINT_ASIDE)
          : notABody(`No dancer moves like this: ${away}.`, HINT_FRAMES);
      }
      const reach = Math.hypot(x - at(J.pelvis, 0), y - at(J.pelvis, 1), z - at(J.pelvis, 2));
      if (reach > MAX_REACH) {
        const away = `${where} is more than ${MAX_REACH} m from the pelvis`;
        throw notABody(`No dancer moves like this: ${away}.`, HINT_FRAMES);
      }
    }
  }
}
