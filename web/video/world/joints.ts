import { LANDMARK_COUNT } from '../pose/landmarks';
import { BALL_SHARE, HEAD_SHARE, NECK_UP } from '../../motion/skeleton/landmarks';
import { J, JOINT_COUNT, SIDES } from '../../motion/skeleton/skeleton';
import { add, lerp, readVec, scale, sub, type Vec3, writeVec } from '../../motion/math/vec3';
import { L } from '../pose/landmark-names';

/** Where joints lie between or beside landmarks, in shares of the trunk from the hips to the shoulders. */
const PELVIS_UP = 0.17;
const SPINE = [0.4, 0.6, 0.74] as const;
/** Collar: from the spine below the neck towards the shoulder. */
const COLLAR_SHARE = 0.4;
const COLLAR_UP = 0.86;

/**
 * The 22 joints of a body from its 33 landmarks.
 * @param landmarks frames x 33 x 3, metres, y up
 * @returns frames x 22 x 3, metres
 */
export function jointsOf(landmarks: Float64Array): Float32Array {
  const frames = landmarks.length / (3 * LANDMARK_COUNT);
  const out = new Float32Array(frames * JOINT_COUNT * 3);
  for (let frame = 0; frame < frames; frame++) {
    const at = (landmark: number): Vec3 => readVec(landmarks, frame * LANDMARK_COUNT + landmark);
    const put = (joint: number, v: Vec3): void => writeVec(out, frame * JOINT_COUNT + joint, v);
    const hips = lerp(at(L.left_hip), at(L.right_hip), 0.5);
    const shoulders = lerp(at(L.left_shoulder), at(L.right_shoulder), 0.5);
    const trunk = sub(shoulders, hips);
    const along = (share: number): Vec3 => add(hips, scale(trunk, share));
    put(J.pelvis, along(PELVIS_UP));
    SPINE.forEach((share, i) => put([J.spine1, J.spine2, J.spine3][i]!, along(share)));
    const neck = along(NECK_UP);
    put(J.neck, neck);
    put(J.head, lerp(neck, lerp(at(L.left_ear), at(L.right_ear), 0.5), HEAD_SHARE));
    const base = along(COLLAR_UP);
    for (const side of SIDES) {
      const shoulder = at(L[`${side}_shoulder`]);
      put(J[`${side}_collar`], lerp(base, shoulder, COLLAR_SHARE));
      put(J[`${side}_shoulder`], shoulder);
      put(J[`${side}_elbow`], at(L[`${side}_elbow`]));
      put(J[`${side}_wrist`], at(L[`${side}_wrist`]));
      put(J[`${side}_hip`], at(L[`${side}_hip`]));
      put(J[`${side}_knee`], at(L[`${side}_knee`]));
      const ankle = at(L[`${side}_ankle`]);
      put(J[`${side}_ankle`], ankle);
      put(J[`${side}_foot`], lerp(ankle, at(L[`${side}_toe`]), BALL_SHARE));
    }
  }
  return out;
}
