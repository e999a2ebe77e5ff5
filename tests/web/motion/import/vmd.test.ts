/** Bones of VMD above the feet, curves, and switches. */
import { expect, test } from 'vitest';
import { mmdBone } from '../../../../web/motion/import/vmd/body';
import { poseAt } from '../../../../web/motion/import/vmd/curve';
import { readVmdFile } from '../../../../web/motion/import/vmd/file';
import { readVmd } from '../../../../web/motion/import/vmd/read';
import { aboutAxis } from '../../../../web/motion/math/quat';
import { direction, distance, sub, type Vec3, X_AXIS, Y_AXIS } from '../../../../web/motion/math/vec3';
import { worldPose } from '../../../../web/motion/retarget/sample';
import { type MadeKey, writeVmd } from '../../support/motion-files/vmd';

const still: MadeKey[] = [
  { bone: 'センター', frame: 0 },
  { bone: 'センター', frame: 30 },
];

const last: MadeKey = { bone: '頭', frame: 30, move: [10, 10, 10], turn: aboutAxis(X_AXIS, 1) };

/** Places of all bones in the first frame. */
function placesOf(...keys: MadeKey[]): readonly Vec3[] {
  const source = readVmd(writeVmd([...still, ...keys]));
  return worldPose(source.joints, source.localPoses([0]), 0).places;
}

const ankle = (...keys: MadeKey[]): Vec3 => placesOf(...keys)[mmdBone('左足首')]!;

test('a foot follows the parent of its IK bone, with and without keys of its own', () => {
  const move = [0, 2, 2] as const;
  const expected = ankle({ bone: '左足ＩＫ', frame: 0, move });
  expect(distance(expected, ankle())).toBeGreaterThan(1);
  const parent = { bone: '左足IK親', frame: 0, move };
  expect(distance(ankle(parent), expected)).toBeLessThan(1e-4);
  expect(distance(ankle(parent, { bone: '左足ＩＫ', frame: 0 }), expected)).toBeLessThan(1e-4);
});

test('a foot that does not reach its IK bone points from where it is to where its toe is to be', () => {
  const move = [0, 12, 0] as const;
  const places = placesOf({ bone: 'グルーブ', frame: 0, move }, { bone: '左足ＩＫ', frame: 0 });
  const rest = placesOf();
  const [at, toe] = ['左足首', '左つま先'].map((name) => places[mmdBone(name)]!) as [Vec3, Vec3];
  expect(at[1]).toBeGreaterThan(rest[mmdBone('左足首')]![1] + 5);
  const foot = direction(sub(toe, at), Y_AXIS);
  const wanted = direction(sub(rest[mmdBone('左つま先')]!, at), Y_AXIS);
  expect(distance(foot, wanted)).toBeLessThan(1e-3);
});

test('every axis and the rotation have curves of their own, and the last key stays', () => {
  const curves = [
    [10, 110, 30, 90],
    [100, 20, 120, 40],
    [50, 5, 60, 15],
    [70, 80, 75, 85],
  ] as const;
  const { bones } = readVmdFile(writeVmd([...still, { bone: '頭', frame: 0 }, { ...last, curves }]));
  const keys = bones.get('頭')!;
  // The switch of physics lies where the first row repeats z and the rotation.
  expect(keys[1]!.curves).toEqual(curves.map((curve) => curve.map((value) => value / 127)));
  const only = (at: number) => {
    const line = [20, 20, 107, 107] as const;
    const one = curves.map((curve, i) => (i === at ? curve : line)) as unknown as typeof curves;
    return poseAt(
      readVmdFile(writeVmd([...still, { bone: '頭', frame: 0 }, { ...last, curves: one }])).bones.get('頭'),
      12,
    );
  };
  const straight = only(-1);
  for (const at of [0, 1, 2, 3] as const) {
    const { move, turn } = only(at);
    const differs = [
      ...move.map((value, axis) => value !== straight.move[axis]),
      turn[0] !== straight.turn[0],
    ];
    expect(differs).toEqual([0, 1, 2, 3].map((axis) => axis === at));
  }
  for (const frame of [30, 40]) expect(poseAt(keys, frame)).toBe(keys[1]);
});

test('switches behind keys of a face, a camera, lights and shadows count from their own frame on', () => {
  const switches = [
    { frame: 10, bone: '左足ＩＫ', on: false },
    { frame: 0, bone: '左足ＩＫ', on: true },
  ];
  const bytes = writeVmd([...still, { bone: '左足ＩＫ', frame: 0, move: [0, 3, 0] }], switches);
  const head = 54 + 3 * 111;
  const others = [23, 61, 28, 9].flatMap((size, kind) => [
    kind + 1,
    0,
    0,
    0,
    ...new Array<number>(size * (kind + 1)).fill(1),
  ]);
  const whole = Uint8Array.from([...bytes.subarray(0, head), ...others, ...bytes.subarray(head + 16)]);
  expect(readVmdFile(whole).switches).toEqual(switches.toReversed());
  const source = readVmd(whole);
  const height = (frame: number): number =>
    worldPose(source.joints, source.localPoses([frame]), 0).places[mmdBone('左足首')]![1];
  expect(height(9)).toBeGreaterThan(height(10) + 2);
  expect(height(10)).toBeCloseTo(height(11), 6);
});
