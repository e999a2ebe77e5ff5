import type { MadeMotion } from './made-motion';
import { scale } from '../../../../web/motion/math/vec3';

/** Markers over time as OpenSim has them. */
export function writeTrc(
  names: readonly string[],
  rows: readonly (readonly (readonly number[])[])[],
  unit: string,
): string {
  return [
    'PathFileType\t4\t(X/Y/Z)\tdance.trc',
    'DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames',
    `60\t60\t${rows.length}\t${names.length}\t${unit}\t60\t1\t${rows.length}`,
    `Frame#\tTime\t${names.map((name) => `${name}\t\t`).join('\t')}`,
    `\t\t${names.map((_, i) => `X${i + 1}\tY${i + 1}\tZ${i + 1}`).join('\t')}`,
    ...rows.map((row, frame) => `${frame + 1}\t${frame / 60}\t${row.flat().join('\t')}`),
    '',
  ].join('\r\n');
}

/** A table of Motive: bones of skeletons with rotations and places, and markers beside them. */
export function writeMotive(skeletons: Readonly<Record<string, MadeMotion>>, space = 'Global'): string {
  const bones = Object.entries(skeletons).flatMap(([skeleton, motion]) =>
    motion.joints.map(({ name }, joint) => ({ motion, joint, name: `${skeleton}:${name}` })),
  );
  const cells = (bone: (name: string) => readonly unknown[], marker: readonly unknown[]): string =>
    [...bones.flatMap(({ name }) => bone(name)), ...marker].join(',');
  const seven = (word: string): string[] => Array<string>(7).fill(word);
  const rotation = [...Array<string>(4).fill('Rotation'), ...Array<string>(3).fill('Position')];
  const position = Array<string>(3).fill('Position');
  const [{ frames, fps }] = Object.values(skeletons) as [MadeMotion];
  return [
    `Format Version,1.25,Take Name,Dance,Take Notes,,Capture Frame Rate,${fps}.000000,Export Frame Rate,${fps}.000000,Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,${space}`,
    '',
    `,Type,${cells(() => seven('Bone'), Array<string>(3).fill('Bone Marker'))}`,
    `,Name,${cells(seven, Array<string>(3).fill('Anna:LThigh1'))}`,
    `,ID,${cells(() => seven('1'), ['1', '1', '1'])}`,
    `,Parent,${cells(() => seven('Root'), ['', '', ''])}`,
    `,,${cells(() => rotation, position)}`,
    `Frame,Time (Seconds),${cells(() => [...'XYZWXYZ'], [...'XYZ'])}`,
    ...Array.from({ length: frames }, (_, frame) => {
      const values = bones.flatMap(({ motion, joint }) => [
        0,
        0,
        0,
        1,
        ...scale(motion.places[frame]![joint]!, 1000),
      ]);
      return [frame, (frame / fps).toFixed(6), ...values, 9, 9, 9].join(',');
    }),
  ].join('\n');
}
