import type { SourceJoint } from '../../retarget/source';
import type { Vec3 } from '../../math/vec3';

/**
 * The body that a VMD moves, as the file holds none: bones of the usual MMD skeleton and their places in the A-pose, in
 * MMD units of 8 cm, right-handed, facing +z. A person of 1.60 m; the arms hang 38 degrees below the horizontal.
 */
const MIDDLE: readonly (readonly [string, string | null, Vec3])[] = [
  ['全ての親', null, [0, 0, 0]],
  ['センター', '全ての親', [0, 8, 0]],
  ['グルーブ', 'センター', [0, 8.2, 0]],
  ['腰', 'グルーブ', [0, 11.6, 0]],
  ['下半身', '腰', [0, 12.2, 0]],
  ['上半身', '腰', [0, 12.2, 0]],
  ['上半身2', '上半身', [0, 13.4, 0]],
  ['首', '上半身2', [0, 16.4, 0]],
  ['頭', '首', [0, 17.2, 0]],
];

const SIDE: readonly (readonly [string, string, Vec3])[] = [
  ['*肩', '上半身2', [0.4, 15.9, 0]],
  ['*腕', '*肩', [1.4, 15.8, 0]],
  ['*腕捩', '*腕', [2.5425, 14.907, 0]],
  ['*ひじ', '*腕捩', [3.685, 14.014, 0]],
  ['*手捩', '*ひじ', [4.749, 13.1825, 0]],
  ['*手首', '*手捩', [5.813, 12.351, 0]],
  ['*足', '下半身', [0.9, 10.8, 0]],
  ['*ひざ', '*足', [0.9, 6.1, 0.1]],
  ['*足首', '*ひざ', [0.9, 1.3, 0]],
  ['*つま先', '*足首', [0.9, 0.2, 1.4]],
  ['*足IK親', '全ての親', [0.9, 0, 0]],
  ['*足ＩＫ', '*足IK親', [0.9, 1.3, 0]],
  ['*つま先ＩＫ', '*足ＩＫ', [0.9, 0.2, 1.4]],
];

const BONES: readonly (readonly [string, string | null, Vec3])[] = [
  ...MIDDLE,
  ...(['左', '右'] as const).flatMap((side) =>
    SIDE.map(
      ([name, parent, [x, y, z]]) =>
        [name.replace('*', side), parent.replace('*', side), [side === '左' ? x : -x, y, z]] as const,
    ),
  ),
];

const NAMES = BONES.map(([name]) => name);

export const MMD_JOINTS: readonly SourceJoint[] = BONES.map(([name, parent]) => ({
  name,
  parent: parent === null ? -1 : NAMES.indexOf(parent),
}));

/** Offset of every bone from its parent. */
export const MMD_OFFSETS: readonly Vec3[] = BONES.map(([, parent, place]) => {
  const above: Vec3 = parent === null ? [0, 0, 0] : BONES[NAMES.indexOf(parent)]![2];
  return [place[0] - above[0], place[1] - above[1], place[2] - above[2]];
});

/** Index of a bone by its name. */
export const mmdBone = (name: string): number => NAMES.indexOf(name);
