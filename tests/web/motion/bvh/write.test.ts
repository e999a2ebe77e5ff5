import { Vector3 } from 'three';
import { BVHLoader } from 'three/addons/loaders/BVHLoader.js';
import { describe, expect, test } from 'vitest';
import { leaderBvh } from '../../support/leader-bvh';
import { BVH_NAMES } from '../../../../web/motion/bvh/names';
import { writeBvh } from '../../../../web/motion/bvh/write';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { aboutAxis, multiply, writeQuat } from '../../../../web/motion/math/quat';
import { J, JOINT_COUNT, SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { solve } from '../../../../web/motion/fit/ik';
import { distance, readVec } from '../../../../web/motion/math/vec3';
import { madeDancer, noisy, random } from '../../support/made-dancer';

const MILLIMETRE = 1e-3;

function farthest(a: Float32Array, b: Float32Array): number {
  expect(a.length).toBe(b.length);
  let most = 0;
  for (let i = 0; i < a.length / 3; i++) most = Math.max(most, distance(readVec(a, i), readVec(b, i)));
  return most;
}

/** Rows of numbers after the header. */
function rows(text: string): number[][] {
  const lines = text.trimEnd().split('\n');
  const first = lines.findIndex((line) => line.startsWith('Frame Time')) + 1;
  return lines.slice(first).map((line) => line.split(' ').map(Number));
}

const spinner = madeDancer({ frames: 200, seed: 3, spin: 1.5 });
const solved = solve({ ...spinner, positions: noisy(spinner.positions, 0.008) });
const text = writeBvh(solved);

describe('what is written is what was solved', () => {
  test('readBvh reads the same motion', () => {
    const { clip, report } = leaderBvh(text);
    expect(clip).toMatchObject({ fps: 30, frames: 200 });
    expect(farthest(clip.positions, solved.positions)).toBeLessThan(MILLIMETRE / 50);
    expect(report).toMatchObject({
      convention: 'ReactDance',
      unit: 'centimetres',
      upAxis: 'y',
      estimated: [],
      warnings: [],
    });
    expect(report.joints.left_ankle).toBe('LeftFoot');
  });

  test.each([
    ['the smallest partner', 0.3],
    ['a child', 0.62],
    ['a giant', 1.35],
    ['the largest partner', 1.5],
  ])('the unit is found again for %s', (_, size) => {
    const motion = solve(madeDancer({ frames: 30, size }));
    const { clip, report } = leaderBvh(writeBvh(motion));
    expect(report.unit).toBe('centimetres');
    expect(farthest(clip.positions, motion.positions)).toBeLessThan(MILLIMETRE / 50);
  });

  test('a dancer who never touches the floor keeps their height', () => {
    const high = solved.positions.map((value, i) => (i % 3 === 1 ? value + 0.05 : value));
    const motion = solve({ ...solved, positions: high });
    expect(farthest(leaderBvh(writeBvh(motion)).clip.positions, motion.positions)).toBeLessThan(
      MILLIMETRE / 50,
    );
  });

  test('a dancer who was moved far off the floor is put on it', () => {
    const high = solved.positions.map((value, i) => (i % 3 === 1 ? value + 0.5 : value));
    const { clip, report } = leaderBvh(writeBvh(solve({ ...solved, positions: high })));
    expect(report.floor).toBeGreaterThan(0.4);
    const low = high.map((value, i) => (i % 3 === 1 ? value - report.floor : value));
    expect(farthest(clip.positions, low)).toBeLessThan(0.02);
  });

  test("three's loader alone places every joint there", () => {
    const { skeleton, clip } = new BVHLoader().parse(text);
    expect(clip.duration).toBeCloseTo(199 / 30, 4);
    const joints = skeleton.bones.filter(({ name }) => name !== 'ENDSITE');
    expect(joints).toHaveLength(1 + JOINT_COUNT);
    for (const frame of [0, 57, 199]) {
      joints.forEach((bone, i) => {
        bone.position.fromArray(clip.tracks[2 * i]!.values, 3 * frame);
        bone.quaternion.fromArray(clip.tracks[2 * i + 1]!.values, 4 * frame);
      });
      joints[0]!.updateMatrixWorld(true);
      for (const bone of joints.slice(1)) {
        const joint = SMPL22.findIndex((name) => BVH_NAMES[name] === bone.name);
        const there = bone.getWorldPosition(new Vector3()).divideScalar(100);
        const wanted = readVec(solved.positions, frame * JOINT_COUNT + joint);
        expect(there.distanceTo(new Vector3(...wanted))).toBeLessThan(MILLIMETRE / 50);
      }
    }
  });
});

describe('what other programs need', () => {
  test('the rest pose is the T-pose in centimetres, with ends at head, hands and toes', () => {
    expect(text).toMatch(
      /^HIERARCHY\nROOT Reference\n\{\n\tOFFSET 0.0000 0.0000 0.0000\n\tCHANNELS 6 Xposition/,
    );
    const { skeleton } = new BVHLoader().parse(text);
    skeleton.bones[0]!.updateMatrixWorld(true);
    const rest = new Map(skeleton.bones.map((bone) => [bone.name, bone.getWorldPosition(new Vector3())]));
    const hips = rest.get('Hips')!;
    expect(rest.get('LeftHand')!.x - hips.x).toBeGreaterThan(60);
    expect(rest.get('RightHand')!.x - hips.x).toBeLessThan(-60);
    // The soles are on the floor.
    const joints = skeleton.bones.slice(1);
    expect(Math.min(...joints.map((bone) => bone.getWorldPosition(new Vector3()).y))).toBeCloseTo(3, 3);
    expect([hips.x, hips.z]).toEqual([0, 0]);
    expect(Math.abs(rest.get('LeftHand')!.y - rest.get('LeftArm')!.y)).toBeLessThan(1e-3);
    expect(rest.get('Hips')!.y - rest.get('LeftFoot')!.y).toBeGreaterThan(75);
    expect(rest.get('LeftToeBase')!.z - rest.get('LeftFoot')!.z).toBeGreaterThan(6);
    const ends = skeleton.bones.filter(({ name }) => name === 'ENDSITE');
    // Above the head, outwards from the hands, ahead of the feet.
    expect(ends.map(({ parent, position }) => [parent!.name, ...position.toArray()])).toEqual(
      expect.arrayContaining([
        ['Head', 0, 18, 0],
        ['LeftHand', 9, 0, 0],
        ['RightHand', -9, 0, 0],
        ['LeftToeBase', 0, 0, 6],
        ['RightToeBase', 0, 0, 6],
      ]),
    );
    expect(ends).toHaveLength(5);
    for (const side of ['Left', 'Right']) {
      for (const joint of ['Foot', 'ToeBase']) expect(rest.has(side + joint)).toBe(true);
    }
  });

  test('duration and columns are right', () => {
    expect(text).toContain('\nFrames: 200\nFrame Time: 0.03333333\n');
    expect(rows(text)).toHaveLength(200);
    for (const row of rows(text)) {
      expect(row).toHaveLength(6 + 3 * JOINT_COUNT);
      expect(row.every(Number.isFinite)).toBe(true);
    }
    expect(text).not.toContain('-0.0000 ');
    expect(text.endsWith('\n')).toBe(true);
  });

  test('bones have constant lengths: only the root has position channels', () => {
    expect(text.match(/position/g)).toHaveLength(3);
  });

  /** The largest change of an angle from one frame to the next, degrees. */
  const largestStep = (angles: readonly number[][]): number =>
    Math.max(
      ...angles.slice(1).flatMap((row, frame) => row.map((angle, i) => Math.abs(angle - angles[frame]![i]!))),
    );

  test('angles do not jump by full turns while the dancer spins', () => {
    const angles = rows(text).map((row) => row.slice(6));
    expect(largestStep(angles)).toBeLessThan(120);
    // Ten turns in one direction: the angle about y of the root goes on and on.
    expect(Math.abs(angles.at(-1)![2]! - angles[0]![2]!)).toBeGreaterThan(3000);
  });

  test('angles do not jump by half turns where a limb turns about x by more than a quarter', () => {
    const made = madeDancer({ frames: 60, seed: 1 });
    const rotations = made.rotations.slice();
    for (let frame = 0; frame < made.frames; frame++) {
      const turn = multiply(aboutAxis([1, 0, 0], 0.05 * frame), aboutAxis([0, 1, 0], 0.4));
      writeQuat(rotations, frame * JOINT_COUNT + J.left_shoulder, turn);
    }
    const angles = rows(writeBvh({ ...made, rotations })).map((row) => row.slice(6));
    expect(largestStep(angles)).toBeLessThan(45);
  });

  test('every rotation is written, at the gimbal lock too', () => {
    const made = madeDancer({ frames: 300, seed: 1 });
    const draw = random(99);
    const rotations = made.rotations.slice();
    for (let frame = 0; frame < made.frames; frame++) {
      for (let joint = 0; joint < JOINT_COUNT; joint++) {
        const quarter = aboutAxis([1, 0, 0], (frame % 3 === 0 ? 1 : -1) * (Math.PI / 2));
        const any = aboutAxis([0, 0, 1], 2 * Math.PI * draw());
        const locked = multiply(any, multiply(quarter, aboutAxis([0, 1, 0], 6 * draw())));
        const turn = frame % 2 === 0 ? locked : multiply(any, aboutAxis([0, 1, 0], 6 * draw()));
        if (joint === J.left_shoulder || joint === J.right_elbow)
          writeQuat(rotations, frame * JOINT_COUNT + joint, turn);
      }
    }
    const positions = forwardKinematics(made.offsets, made.root, rotations);
    const { clip } = leaderBvh(writeBvh({ ...made, rotations, positions }));
    expect(farthest(clip.positions, positions)).toBeLessThan(MILLIMETRE);
  });

  test('a motion without frames is refused', () => {
    expect(() => writeBvh({ ...solved, frames: 0 })).toThrow(RangeError);
  });
});
