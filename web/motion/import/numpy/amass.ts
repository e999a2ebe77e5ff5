import { AVERAGE_BODY } from '../average-body';
import { refuseTooFew } from '../../retarget/length';
import { SMPL_JOINTS } from '../positions';
import type { NpzArray } from '../../../common/npz';
import { aboutAxis, type Quat, writeQuat, IDENTITY } from '../../math/quat';
import { length, scale, type Vec3, writeVec } from '../../math/vec3';
import { type LocalPoses, type MotionSource, restOf } from '../../retarget/source';
import { JOINT_COUNT, SMPL22 } from '../../skeleton/skeleton';

/** A rotation vector (axis times angle, radians) as a quaternion. */
function fromRotationVector(v: Vec3): Quat {
  const angle = length(v);
  return angle > 1e-9 ? aboutAxis(scale(v, 1 / angle), angle) : IDENTITY;
}

/**
 * SMPL rotations on the average body (average-body.ts): the weights of the SMPL body are not free, so its shape
 * parameters are not used.
 *
 * @param poses (T, 66 or more): rotation vectors of the joints, the 22 of the body first
 * @param trans (T, 3) metres, or null where the body stays in place
 */
export function sourceOfRotations(
  poses: NpzArray,
  trans: NpzArray | null,
  about: Pick<MotionSource, 'frameRate' | 'rateAssumed'>,
): MotionSource {
  const [frames = 0, width = 0] = poses.shape;
  refuseTooFew(frames);
  const offsets = new Float32Array(SMPL22.flatMap((joint) => AVERAGE_BODY[joint]));
  const localPoses = (wanted: readonly number[]): LocalPoses => {
    const rotations = new Float32Array(wanted.length * JOINT_COUNT * 4);
    const translations = new Float32Array(wanted.length * JOINT_COUNT * 3);
    wanted.forEach((frame, place) => {
      translations.set(offsets, place * JOINT_COUNT * 3);
      const value = (from: NpzArray, index: number): number => from.data[index]!;
      if (trans)
        writeVec(translations, place * JOINT_COUNT, [
          value(trans, 3 * frame),
          value(trans, 3 * frame + 1),
          value(trans, 3 * frame + 2),
        ]);
      for (let joint = 0; joint < JOINT_COUNT; joint++) {
        const at = frame * width + 3 * joint;
        const turn = fromRotationVector([value(poses, at), value(poses, at + 1), value(poses, at + 2)]);
        writeQuat(rotations, place * JOINT_COUNT + joint, turn);
      }
    });
    return { rotations, translations };
  };
  return {
    ...about,
    format: 'AMASS (SMPL rotations)',
    joints: SMPL_JOINTS,
    rest: restOf(offsets),
    frames,
    unit: { name: 'metres', metres: 1 },
    upAxis: 'z',
    parts: [],
    part: 0,
    warnings: ['The file holds rotations without a body, so that of an average adult is used.'],
    truncated: false,
    localPoses,
  };
}
