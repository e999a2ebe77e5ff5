import type { JointName } from '../../skeleton/skeleton';
import {
  add,
  cross,
  direction,
  distance,
  dot,
  lerp,
  length,
  scale,
  sub,
  type Vec3,
  X_AXIS,
  Z_AXIS,
} from '../../math/vec3';

/** A marker's place in a frame, by its label. */
export type Markers = (label: string) => Vec3;

/** Markers of the Plug-in Gait set that are needed; the pelvis has two behind, or one in the middle (SACR). */
export const NEEDED = [
  ...['ASI', 'KNE', 'ANK', 'TOE', 'SHO', 'ELB'].flatMap((name) => [`L${name}`, `R${name}`]),
  'C7',
  'CLAV',
];
/** Other markers that make joints better. */
export const OPTIONAL = [
  ...['PSI', 'HEE', 'WRA', 'WRB', 'FHD', 'BHD', 'FIN', 'THI', 'TIB', 'UPA', 'FRM'].flatMap((name) => [
    `L${name}`,
    `R${name}`,
  ]),
  'SACR',
  'T10',
  'STRN',
  'RBAK',
];

/** Half widths of joints with their marker, metres: a marker lies on the skin outside of the joint's centre. */
const HALF_KNEE = 0.06;
const HALF_ANKLE = 0.045;
const HALF_ELBOW = 0.045;
/** The shoulder's centre is below its marker, which lies on the acromion, metres. */
const BELOW_ACROMION = 0.05;

/**
 * The point beside `place` by a distance along the part of `towards` that is perpendicular to the bone from `from`: less
 * where the bone itself lies along `towards`, as an arm held out to the side.
 */
function inwards(place: Vec3, from: Vec3, towards: Vec3, by: number): Vec3 {
  const bone = direction(sub(place, from), Z_AXIS);
  const across = sub(towards, scale(bone, dot(towards, bone)));
  return add(place, scale(across, by));
}

/**
 * Centres of joints from markers of Plug-in Gait. Hips by the regression of Harrington et al. (2007) over the pelvis's
 * width and depth; knees, ankles and elbows half their width inwards of their markers.
 *
 * @param markers places in any unit
 * @param has whether a marker is in the file
 * @param metres metres in a unit
 */
export function jointsOfMarkers(
  markers: Markers,
  has: (label: string) => boolean,
  metres: number,
): Map<JointName, Vec3> {
  const joints = new Map<JointName, Vec3>();
  const middle = (a: string, b: string): Vec3 => lerp(markers(a), markers(b), 0.5);
  const front = middle('LASI', 'RASI');
  const back = has('LPSI') && has('RPSI') ? middle('LPSI', 'RPSI') : markers('SACR');
  const left = direction(sub(markers('LASI'), markers('RASI')), X_AXIS);
  const ahead = direction(sub(sub(front, back), scale(left, dot(sub(front, back), left))), Z_AXIS);
  const up = cross(ahead, left);
  const width = distance(markers('LASI'), markers('RASI'));
  const depth = length(sub(front, back));
  const millimetre = 0.001 / metres;
  for (const [side, sign] of [
    ['left', 1],
    ['right', -1],
  ] as const) {
    const l = side === 'left' ? 'L' : 'R';
    const marker = (name: string): Vec3 => markers(`${l}${name}`);
    const inner = scale(left, -sign);
    const hip = add(
      front,
      add(
        scale(ahead, -0.24 * depth - 9.9 * millimetre),
        add(
          scale(up, -0.3 * width - 10.9 * millimetre),
          scale(left, sign * (0.33 * width + 7.3 * millimetre)),
        ),
      ),
    );
    const knee = inwards(marker('KNE'), hip, inner, HALF_KNEE / metres);
    const ankle = inwards(marker('ANK'), knee, inner, HALF_ANKLE / metres);
    const shoulders = direction(sub(markers('RSHO'), markers('LSHO')), scale(X_AXIS, -1));
    const spine = direction(sub(middle('LSHO', 'RSHO'), lerp(front, back, 0.5)), up);
    const shoulder = sub(marker('SHO'), scale(spine, BELOW_ACROMION / metres));
    const elbow = inwards(marker('ELB'), shoulder, scale(shoulders, sign), HALF_ELBOW / metres);
    const wrist = has(`${l}WRA`) && has(`${l}WRB`) ? lerp(marker('WRA'), marker('WRB'), 0.5) : marker('FIN');
    joints.set(`${side}_hip`, hip);
    joints.set(`${side}_knee`, knee);
    joints.set(`${side}_ankle`, ankle);
    joints.set(`${side}_foot`, marker('TOE'));
    joints.set(`${side}_shoulder`, shoulder);
    joints.set(`${side}_elbow`, elbow);
    joints.set(`${side}_wrist`, wrist);
  }
  const neck = lerp(markers('C7'), markers('CLAV'), 0.4);
  joints.set('neck', neck);
  if (['LFHD', 'RFHD', 'LBHD', 'RBHD'].every(has))
    joints.set('head', lerp(neck, lerp(middle('LFHD', 'RFHD'), middle('LBHD', 'RBHD'), 0.5), 0.6));
  return joints;
}
