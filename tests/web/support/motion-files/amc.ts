import { Euler, Quaternion } from 'three';
import type { BodyNames } from '../made-bvh';
import type { MadeMotion } from './made-motion';
import { aboutAxis, conjugate, multiply, type Quat } from '../../../../web/motion/math/quat';
import { X_AXIS, Y_AXIS, Z_AXIS } from '../../../../web/motion/math/vec3';

/** Bones of the CMU library's skeletons. */
export const ASF_NAMES: BodyNames = {
  root: 'root',
  spine: ['lowerback', 'upperback', 'thorax'],
  neck: 'lowerneck',
  head: 'head',
  sides: ['l', 'r'],
  hip: '*femur',
  knee: '*tibia',
  ankle: '*foot',
  toe: '*toes',
  collar: '*clavicle',
  shoulder: '*humerus',
  elbow: '*radius',
  wrist: '*wrist',
};

const METRES = 0.0254 / 0.45;
const DEGREES = 180 / Math.PI;

interface Options {
  /** Angles in radians in place of degrees. */
  readonly inRadians?: boolean;
  /** Bones below the root turn about z first, and about x last. */
  readonly zFirst?: boolean;
  /** Lines of the hierarchy from the tips to the root. */
  readonly tipsFirst?: boolean;
}

/** The motion as an AMC and its ASF: a bone without motion leads to every joint, whose own bone has axes of its own. */
export function writeAmc(
  motion: MadeMotion,
  { inRadians = false, zFirst = false, tipsFirst = false }: Options = {},
): { amc: Uint8Array; asf: Uint8Array } {
  const { joints } = motion;
  const words = (angles: readonly number[]): string =>
    angles.map((angle) => (inRadians ? angle.toFixed(9) : (angle * DEGREES).toFixed(7))).join(' ');
  const eulerXyz = (q: Quat): string => {
    const { x, y, z } = new Euler().setFromQuaternion(new Quaternion(...q), 'ZYX');
    return words([x, y, z]);
  };
  const eulerZyx = (q: Quat): string => {
    const { x, y, z } = new Euler().setFromQuaternion(new Quaternion(...q), 'XYZ');
    return words([z, y, x]);
  };
  const axes = joints.map((_, i) =>
    i === 0
      ? ([0, 0, 0, 1] as const)
      : multiply(
          aboutAxis(Z_AXIS, 0.3 * i),
          multiply(aboutAxis(Y_AXIS, 1 - 0.2 * i), aboutAxis(X_AXIS, 0.1 * i)),
        ),
  );
  const bones = joints.flatMap(({ name, offset }, i) => {
    if (i === 0) return [];
    const length = Math.hypot(...offset);
    const direction = offset.map((value) => (value / length).toFixed(9)).join(' ');
    return [
      `begin\nid ${2 * i}\nname to_${name}\ndirection ${direction}\nlength ${(length / METRES).toFixed(7)}\naxis 0 0 0 XYZ\nend`,
      `begin\nid ${2 * i + 1}\nname ${name}\ndirection 0 0 0\nlength 0\naxis ${eulerXyz(axes[i]!)} XYZ\ndof ${zFirst ? 'rz ry rx' : 'rx ry rz'}\nlimits (-180 180)\n(-180 180)\n(-180 180)\nend`,
    ];
  });
  const hierarchy = joints.flatMap(({ name }, i) => {
    const children = joints.flatMap(({ name: child, parent }) => (parent === i ? [`to_${child}`] : []));
    return [
      ...(i === 0 ? [] : [`to_${name} ${name}`]),
      ...(children.length > 0 ? [`${name} ${children.join(' ')}`] : []),
    ];
  });
  const asf = [
    ':version 1.10\n:name made\n:units\nmass 1.0\nlength 0.45\nangle ' + (inRadians ? 'rad' : 'deg'),
    ':root\norder TX TY TZ RX RY RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0',
    `:bonedata\n${bones.join('\n')}`,
    `:hierarchy\nbegin\n${(tipsFirst ? hierarchy.toReversed() : hierarchy).join('\n')}\nend\n`,
  ].join('\n');
  const rows = motion.rotations.map((turns, frame) => {
    const lines = joints.map(({ name }, i) => {
      const own = multiply(multiply(conjugate(axes[i]!), turns[i]!), axes[i]!);
      const place = motion.root[frame]!.map((value) => (value / METRES).toFixed(7)).join(' ');
      return i === 0 ? `root ${place} ${eulerXyz(own)}` : `${name} ${zFirst ? eulerZyx(own) : eulerXyz(own)}`;
    });
    return [frame + 1, ...lines].join('\n');
  });
  const utf8 = (text: string): Uint8Array => new TextEncoder().encode(text);
  return {
    asf: utf8(asf),
    amc: utf8(`#!OML:ASF\n:FULLY-SPECIFIED\n${inRadians ? ':RADIANS' : ':DEGREES'}\n${rows.join('\n')}\n`),
  };
}
