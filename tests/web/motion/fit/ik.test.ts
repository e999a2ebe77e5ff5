import { Object3D, Quaternion, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import type { MotionClip, SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import {
  aboutAxis,
  IDENTITY,
  multiply,
  type Quat,
  quatDot,
  readQuat,
  rotate,
  writeQuat,
} from '../../../../web/motion/math/quat';
import { J, JOINT_COUNT, MIRROR, PARENTS } from '../../../../web/motion/skeleton/skeleton';
import { solve } from '../../../../web/motion/fit/ik';
import { direction, distance, dot, readVec, sub, type Vec3 } from '../../../../web/motion/math/vec3';
import { madeDancer, noisy } from '../../support/made-dancer';

const at = (positions: Float32Array, frame: number, joint: number) =>
  readVec(positions, frame * JOINT_COUNT + joint);

/** A dancer in the rest pose but for the rotations that are given. */
function posed(frames: number, turnOf: (joint: number, frame: number) => Quat | null): SolvedMotion {
  const made = madeDancer({ frames });
  const rotations = made.rotations.slice();
  for (let i = 0; i < frames * JOINT_COUNT; i++)
    writeQuat(rotations, i, turnOf(i % JOINT_COUNT, Math.floor(i / JOINT_COUNT)) ?? IDENTITY);
  return { ...made, rotations, positions: forwardKinematics(made.offsets, made.root, rotations) };
}

/** Largest turn of a joint from one frame to the next, degrees. */
function fastestTurn(motion: SolvedMotion, joint: number): number {
  let fastest = 0;
  for (let frame = 1; frame < motion.frames; frame++) {
    const a = readQuat(motion.rotations, (frame - 1) * JOINT_COUNT + joint);
    const b = readQuat(motion.rotations, frame * JOINT_COUNT + joint);
    fastest = Math.max(fastest, 2 * Math.acos(Math.min(1, Math.abs(quatDot(a, b)))));
  }
  return (fastest * 180) / Math.PI;
}

/** The rotations of a motion with those of one joint as in the world. */
function worldRotations({ rotations, frames }: SolvedMotion, joint: number): Float32Array {
  const world = rotations.slice();
  for (let frame = 0; frame < frames; frame++) {
    const row = frame * JOINT_COUNT;
    let turn = readQuat(rotations, row + joint);
    for (let above = PARENTS[joint]!; above >= 0; above = PARENTS[above]!)
      turn = multiply(readQuat(rotations, row + above), turn);
    writeQuat(world, row + joint, turn);
  }
  return world;
}

function meanDistance(a: Float32Array, b: Float32Array): number {
  let sum = 0;
  for (let i = 0; i < a.length / 3; i++) sum += distance(readVec(a, i), readVec(b, i));
  return sum / (a.length / 3);
}

/** Signs that must hold for whatever was solved. */
function expectSound(clip: MotionClip, solved: SolvedMotion): void {
  expect([...solved.rotations, ...solved.root, ...solved.offsets].every(Number.isFinite)).toBe(true);
  const again = forwardKinematics(solved.offsets, solved.root, solved.rotations);
  let length = 0;
  let apart = 0;
  let unit = 0;
  let flips = 0;
  for (let frame = 0; frame < clip.frames; frame++) {
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const i = frame * JOINT_COUNT + joint;
      const parent = PARENTS[joint]!;
      apart = Math.max(apart, distance(readVec(again, i), readVec(solved.positions, i)));
      if (parent >= 0) {
        const bone = distance(readVec(solved.positions, i), at(solved.positions, frame, parent));
        length = Math.max(length, Math.abs(bone - Math.hypot(...readVec(solved.offsets, joint))));
      }
      const q = readQuat(solved.rotations, i);
      unit = Math.max(unit, Math.abs(quatDot(q, q) - 1));
      if (frame > 0 && quatDot(q, readQuat(solved.rotations, i - JOINT_COUNT)) < 0) flips++;
    }
  }
  expect(length).toBeLessThan(1e-6);
  expect(apart).toBe(0);
  expect(unit).toBeLessThan(1e-6);
  expect(flips).toBe(0);
  expect(solved.fitError).toBeCloseTo(meanDistance(solved.positions, clip.positions), 6);
}

describe('forward kinematics', () => {
  test('agrees with three', () => {
    const motion = madeDancer({ frames: 5, seed: 3, spin: 0.4 });
    const bones = PARENTS.map((_, joint) => {
      const bone = new Object3D();
      bone.position.fromArray(motion.offsets, 3 * joint);
      return bone;
    });
    PARENTS.forEach((parent, joint) => parent >= 0 && bones[parent]!.add(bones[joint]!));
    for (let frame = 0; frame < motion.frames; frame++) {
      bones[0]!.position.fromArray(motion.root, 3 * frame);
      bones.forEach((bone, joint) =>
        bone.quaternion.copy(new Quaternion().fromArray(motion.rotations, 4 * (frame * JOINT_COUNT + joint))),
      );
      bones[0]!.updateMatrixWorld(true);
      bones.forEach((bone, joint) => {
        const there = bone.getWorldPosition(new Vector3());
        expect(there.distanceTo(new Vector3(...at(motion.positions, frame, joint)))).toBeLessThan(1e-6);
      });
    }
  });
});

describe('a dancer on constant bones', () => {
  test.each([1, 2, 3, 4, 5, 6])('is recovered to a fraction of a millimetre, seed %i', (seed) => {
    const made = madeDancer({ frames: 150, seed, spin: 0.2 * seed, size: 0.9 + 0.05 * seed });
    const solved = solve(made);
    expectSound(made, solved);
    expect(solved.fitError).toBeLessThan(2e-4);
    for (let joint = 1; joint < JOINT_COUNT; joint++) {
      const [found, truth] = [readVec(solved.offsets, joint), readVec(made.offsets, joint)];
      expect(Math.abs(Math.hypot(...found) - Math.hypot(...truth))).toBeLessThan(1e-4);
      // The shoulders' and feet's rest directions are means over the clip, free within what the dancer does.
      const free = [J.left_shoulder, J.right_shoulder, J.left_foot, J.right_foot].includes(joint);
      if (!free) expect(distance(found, truth)).toBeLessThan(0.012);
    }
  });

  test.each([11, 12, 13])('is recovered closely under a centimetre of noise, seed %i', (seed) => {
    const made = madeDancer({ frames: 150, seed });
    const clip: MotionClip = { ...made, positions: noisy(made.positions, 0.01, seed) };
    const solved = solve(clip);
    expectSound(clip, solved);
    expect(solved.fitError).toBeLessThan(0.014);
    // Nearer to the truth than the noise that came in, whose mean length is 16 mm.
    expect(meanDistance(solved.positions, made.positions)).toBeLessThan(0.0145);
  });

  test('keeps standing feet in place although the observed bone lengths change', () => {
    const made = madeDancer({ frames: 120, seed: 21 });
    const positions = made.positions.slice();
    // Knees that wander by 2 cm: the legs' lengths change, the ankles do not.
    for (let frame = 0; frame < made.frames; frame++) {
      for (const knee of [J.left_knee, J.right_knee]) {
        positions[(frame * JOINT_COUNT + knee) * 3]! += 0.02 * Math.sin(frame / 5);
      }
    }
    const solved = solve({ ...made, positions });
    for (const ankle of [J.left_ankle, J.right_ankle]) {
      for (let frame = 0; frame < made.frames; frame++) {
        expect(distance(at(solved.positions, frame, ankle), at(positions, frame, ankle))).toBeLessThan(
          0.0055,
        );
      }
    }
  });

  test('of one frame is solved', () => {
    const made = madeDancer({ frames: 1 });
    expectSound(made, solve(made));
  });

  test('gets left and right bones of one length', () => {
    const made = madeDancer({ frames: 30 });
    const offsets = made.offsets.slice();
    offsets[3 * J.left_elbow]! += 0.02;
    const { root, rotations } = made;
    const solved = solve({ ...made, positions: forwardKinematics(offsets, root, rotations) });
    PARENTS.forEach((_, joint) => {
      const [x, y, z] = readVec(solved.offsets, joint);
      const [mx, my, mz] = readVec(solved.offsets, MIRROR[joint]!);
      expect([-mx, my, mz].map((value, i) => Math.abs(value - [x, y, z][i]!)).every((d) => d < 1e-6)).toBe(
        true,
      );
    });
    expect(solved.offsets[3 * J.left_elbow]).toBeCloseTo(0.28, 4);
  });
});

describe('the rest pose', () => {
  const { offsets } = solve(madeDancer({ frames: 90, seed: 5, spin: 0.5 }));
  test('is a T-pose facing +z', () => {
    for (const joint of [J.left_elbow, J.left_wrist]) {
      const [x, y, z] = readVec(offsets, joint);
      expect(x).toBeGreaterThan(0.2);
      expect([y, z]).toEqual([0, 0]);
    }
    for (const joint of [J.left_knee, J.right_ankle]) {
      const [x, y, z] = readVec(offsets, joint);
      expect(y).toBeLessThan(-0.3);
      expect([x, z]).toEqual([0, 0]);
    }
    expect(offsets[3 * J.left_hip]!).toBeGreaterThan(0.05);
    expect(offsets[3 * J.left_foot + 2]!).toBeGreaterThan(0.07);
    expect(offsets[3 * J.head + 1]!).toBeGreaterThan(0.05);
    expect([...readVec(offsets, J.pelvis)]).toEqual([0, 0, 0]);
  });

  test('has the feet of standing, not of jumping, and neither toes up nor straight down', () => {
    /** The slope of the foot where it turns by so much, for three quarters of the time a metre higher. */
    const slope = (standing: number, inTheAir: number): number => {
      const angle = (frame: number): number => (frame < 30 ? standing : inTheAir);
      const made = posed(120, (joint, frame) =>
        joint === J.left_ankle || joint === J.right_ankle ? aboutAxis([1, 0, 0], angle(frame)) : null,
      );
      const positions = made.positions.map((value, i) =>
        i % 3 === 1 && i >= 30 * JOINT_COUNT * 3 ? value + 1 : value,
      );
      const [, y, z] = readVec(solve({ ...made, positions }).offsets, J.left_foot);
      return y / Math.hypot(y, z);
    };
    const rest = -0.04 / Math.hypot(0.04, 0.1);
    expect(slope(0, 0.8)).toBeCloseTo(rest, 3);
    expect(slope(-1, 0)).toBeCloseTo(0, 6);
    expect(slope(1.3, 0)).toBeCloseTo(-0.9, 3);
  });

  test('has no rotation in the rest pose', () => {
    const made = madeDancer({ frames: 20, seed: 2 });
    const still = made.rotations.map((_, i) => (i % 4 === 3 ? 1 : 0));
    const posed = { ...made, positions: forwardKinematics(made.offsets, made.root, still) };
    const solved = solve(posed);
    for (let i = 0; i < solved.rotations.length / 4; i++) {
      expect(Math.abs(readQuat(solved.rotations, i)[3])).toBeGreaterThan(0.999999);
    }
  });
});

describe('rotations over time', () => {
  test('a dancer who spins twice a second turns smoothly, limbs unchanged', () => {
    const slow = solve(madeDancer({ frames: 120, seed: 8, spin: 0 }));
    const fast = solve(madeDancer({ frames: 120, seed: 8, spin: 2 }));
    expect(fastestTurn(fast, J.pelvis)).toBeLessThan(25);
    for (let joint = 1; joint < JOINT_COUNT; joint++) {
      expect(Math.abs(fastestTurn(fast, joint) - fastestTurn(slow, joint))).toBeLessThan(0.5);
    }
  });

  test('a chest that is turned against the hips turns the whole spine, a third at each joint', () => {
    const made = madeDancer({ frames: 30, seed: 2 });
    const rotations = made.rotations.map((_, i) => (i % 4 === 3 ? 1 : 0));
    for (let frame = 0; frame < made.frames; frame++) {
      writeQuat(rotations, frame * JOINT_COUNT + J.spine3, aboutAxis([0, 1, 0], Math.PI / 4));
    }
    const positions = forwardKinematics(made.offsets, made.root, rotations);
    const solved = solve({ ...made, positions });
    for (const joint of [J.spine1, J.spine2, J.spine3]) {
      const [x, y, z, w] = readQuat(solved.rotations, joint);
      expect(2 * Math.atan2(y, w)).toBeCloseTo(Math.PI / 12, 4);
      expect(Math.hypot(x, z)).toBeLessThan(1e-4);
    }
  });

  test('a chest that turns all the way round against the hips turns every joint of the spine smoothly', () => {
    const made = madeDancer({ frames: 31, seed: 2 });
    const rotations = made.rotations.map((_, i) => (i % 4 === 3 ? 1 : 0));
    for (let frame = 0; frame < made.frames; frame++)
      writeQuat(rotations, frame * JOINT_COUNT + J.spine3, aboutAxis([0, 1, 0], (Math.PI * frame) / 15));
    const positions = forwardKinematics(made.offsets, made.root, rotations);
    const solved = solve({ ...made, positions }, made.offsets);
    for (const joint of [J.spine1, J.spine2, J.spine3]) expect(fastestTurn(solved, joint)).toBeLessThan(45);
  });

  // At three quarters of a turn quaternions are found with the other sign.
  test.each([0, 0.5])(
    'a chest whose collars change sides turns there, and hips as well (spin %f)',
    (spin) => {
      const made = madeDancer({ frames: 90, seed: 4, spin });
      const positions = made.positions.slice();
      const sides = [
        [J.left_collar, J.right_collar],
        [J.left_hip, J.right_hip],
      ] as const;
      for (let frame = 0; frame < made.frames; frame++) {
        // From 1 to -1 within half a second; all other joints stay.
        const share = Math.max(-1, Math.min(1, (45 - frame) / 7.5));
        for (const [left, right] of sides)
          for (let axis = 0; axis < 3; axis++) {
            const [l, r] = [left, right].map((joint) => 3 * (frame * JOINT_COUNT + joint) + axis) as [
              number,
              number,
            ];
            const [middle, half] = [(positions[l]! + positions[r]!) / 2, (positions[l]! - positions[r]!) / 2];
            [positions[l], positions[r]] = [middle + share * half, middle - share * half];
          }
      }
      const turned = solve({ ...made, positions }, made.offsets);
      expect(fastestTurn(turned, J.pelvis)).toBeLessThan(45);
      const chest = worldRotations(turned, J.spine3);
      expect(fastestTurn({ ...turned, rotations: chest }, J.spine3)).toBeLessThan(45);
      const before = solve(made, made.offsets);
      // A micrometre: twists are smoothed over the whole clip.
      for (let i = 0; i < 30 * JOINT_COUNT * 3; i++)
        expect(turned.positions[i]).toBeCloseTo(before.positions[i]!, 6);
    },
  );

  test('a chest that a decoder blends into its place after a turn goes round with the hips', () => {
    // The hips turn half round to the left in half a second, the chest from 20 degrees behind to 20 degrees ahead of
    // them. Between the two its joints are in straight lines, which pass the spine on the right.
    const turned = (degrees: number): Quat => aboutAxis([0, 1, 0], (Math.PI * degrees) / 180);
    const shareAt = (frame: number): number => Math.max(0, Math.min(1, (frame - 30) / 15));
    const couple = [-20, 20].map((ahead) =>
      posed(80, (joint, frame) =>
        joint === J.pelvis
          ? turned(180 * shareAt(frame))
          : joint === J.spine3
            ? turned(ahead + 180 * (Math.round((ahead + 20) / 40) - shareAt(frame)))
            : null,
      ),
    );
    const [before, after] = couple as [SolvedMotion, SolvedMotion];
    const positions = before.positions.map((value, i) => {
      const share = shareAt(Math.floor(i / (3 * JOINT_COUNT)));
      return value + share * (after.positions[i]! - value);
    });
    const solved = solve({ ...before, positions }, before.offsets);
    const [pelvis, chest] = [J.pelvis, J.spine3].map((joint) => worldRotations(solved, joint)) as [
      Float32Array,
      Float32Array,
    ];
    for (let frame = 0; frame < solved.frames; frame++) {
      const row = frame * JOINT_COUNT;
      const alike = Math.abs(quatDot(readQuat(pelvis, row + J.pelvis), readQuat(chest, row + J.spine3)));
      expect(2 * Math.acos(Math.min(1, alike)), `frame ${frame}`).toBeLessThan(Math.PI / 2);
    }
    // As fast as a captured dancer's ever turns.
    expect(fastestTurn({ ...solved, rotations: chest }, J.spine3)).toBeLessThan(26);
  });

  test('a forearm that is folded onto the upper arm, and past it, does not flip', () => {
    const fold = (frame: number): number => (Math.PI * (140 + 2 * Math.min(frame, 30))) / 180;
    const made = posed(60, (joint, frame) =>
      joint === J.left_elbow ? aboutAxis([0, -1, 0.1], fold(frame)) : null,
    );
    const solved = solve(made, made.offsets);
    expect(fastestTurn(solved, J.left_elbow)).toBeLessThan(20);
  });

  test('knees and elbows bend about their hinges', () => {
    const solved = solve(madeDancer({ frames: 150, seed: 4 }));
    const hinges = [
      [J.left_knee, [1, 0, 0]],
      [J.right_knee, [1, 0, 0]],
      [J.left_elbow, [0, -1, 0]],
      [J.right_elbow, [0, 1, 0]],
    ] as const;
    for (const [joint, axis] of hinges) {
      for (let frame = 0; frame < solved.frames; frame++) {
        const [x, y, z, w] = readQuat(solved.rotations, frame * JOINT_COUNT + joint);
        const size = Math.hypot(x, y, z) * Math.sign(w);
        const along = (x * axis[0] + y * axis[1] + z * axis[2]) / size;
        expect(along).toBeGreaterThan(0.9);
      }
    }
  });

  test("elbows fold no farther than people's", () => {
    const made = madeDancer({ frames: 90, seed: 4, bend: (_, seconds) => 2.6 + 0.5 * Math.sin(3 * seconds) });
    const solved = solve(made, made.offsets);
    const fold = (motion: SolvedMotion, frame: number): number => {
      const [shoulder, elbow, wrist] = [J.left_shoulder, J.left_elbow, J.left_wrist].map((joint) =>
        readVec(motion.positions, frame * JOINT_COUNT + joint),
      ) as [Vec3, Vec3, Vec3];
      const [up, down] = [
        direction(sub(shoulder, elbow), [0, 1, 0]),
        direction(sub(wrist, elbow), [0, 1, 0]),
      ];
      return (Math.acos(Math.min(1, dot(up, down))) * 180) / Math.PI;
    };
    const frames = Array.from({ length: 90 }, (_, frame) => frame);
    expect(Math.min(...frames.map((frame) => fold(made, frame)))).toBeLessThan(10);
    expect(Math.min(...frames.map((frame) => fold(solved, frame)))).toBeGreaterThan(24.9);
    for (const frame of frames)
      if (fold(made, frame) > 26) expect(fold(solved, frame)).toBeCloseTo(fold(made, frame), 1);
  });

  test('a straight leg that is turned out turns at the hip, as its foot shows', () => {
    const made = posed(30, (joint) => (joint === J.left_hip ? aboutAxis([0, 1, 0], 0.6) : null));
    const solved = solve(made);
    const [, y, , w] = readQuat(solved.rotations, 15 * JOINT_COUNT + J.left_hip);
    expect(2 * Math.atan2(y, w)).toBeCloseTo(0.6, 2);
  });

  test('head, hands and balls of the feet, which positions do not show, do not turn', () => {
    const solved = solve(madeDancer({ frames: 60, seed: 3 }));
    for (let frame = 0; frame < solved.frames; frame++)
      for (const joint of [J.head, J.left_wrist, J.right_wrist, J.left_foot, J.right_foot])
        expect(Math.abs(readQuat(solved.rotations, frame * JOINT_COUNT + joint)[3])).toBeGreaterThan(
          0.999999,
        );
  });

  test('an arm that is stretched for a while does not twist, however noisy', () => {
    // Bent, straight for two seconds, bent again: while straight the hinge shows only noise.
    const bend = (_: number, seconds: number): number =>
      seconds < 1 || seconds > 3 ? 0.9 : 0.9 * Math.max(0, Math.abs(seconds - 2) - 0.5) * 2;
    const made = madeDancer({ frames: 120, seed: 6, bend });
    const clip = { ...made, positions: noisy(made.positions, 0.003) };
    const solved = solve(clip);
    expectSound(clip, solved);
    for (const joint of [J.left_shoulder, J.right_shoulder, J.left_elbow, J.right_elbow]) {
      expect(fastestTurn(solved, joint) - fastestTurn(made, joint)).toBeLessThan(10);
    }
  });

  test('limbs that are straight from first to last frame are solved without a twist', () => {
    const made = madeDancer({ frames: 90, seed: 9, bend: () => 0 });
    const solved = solve(made);
    expectSound(made, solved);
    expect(solved.fitError).toBeLessThan(2e-4);
    for (let joint = 0; joint < JOINT_COUNT; joint++) expect(fastestTurn(solved, joint)).toBeLessThan(20);
  });
});

test('a mirrored dancer is solved as the mirror image', () => {
  const made = madeDancer({ frames: 60, seed: 14, spin: 0.3 });
  const mirrored = made.positions.slice();
  for (let i = 0; i < made.frames * JOINT_COUNT; i++) {
    const frame = Math.floor(i / JOINT_COUNT);
    const [x, y, z] = at(made.positions, frame, MIRROR[i % JOINT_COUNT]!);
    mirrored.set([-x, y, z], 3 * i);
  }
  const [one, other] = [solve(made), solve({ ...made, positions: mirrored })];
  for (let i = 0; i < made.frames * JOINT_COUNT; i++) {
    const frame = Math.floor(i / JOINT_COUNT);
    const twin = frame * JOINT_COUNT + MIRROR[i % JOINT_COUNT]!;
    const [x, y, z, w] = readQuat(one.rotations, twin);
    expect(Math.abs(quatDot(readQuat(other.rotations, i), [x, -y, -z, w]))).toBeGreaterThan(0.99999);
  }
});

test('the whole clip turned in the world turns only the root', () => {
  const made = madeDancer({ frames: 40, seed: 15 });
  const turn = [0, Math.sin(0.6), 0, Math.cos(0.6)] as const;
  const turned = made.positions.slice();
  for (let i = 0; i < turned.length / 3; i++) turned.set(rotate(turn, readVec(made.positions, i)), 3 * i);
  const [one, other] = [solve(made), solve({ ...made, positions: turned })];
  for (let i = 0; i < made.frames * JOINT_COUNT; i++) {
    if (i % JOINT_COUNT === J.pelvis) continue;
    expect(Math.abs(quatDot(readQuat(one.rotations, i), readQuat(other.rotations, i)))).toBeGreaterThan(
      0.99999,
    );
  }
  expect(distance(rotate(turn, readVec(one.root, 7)), readVec(other.root, 7))).toBeLessThan(1e-5);
});

test('a solved motion is solved to itself', () => {
  const made = madeDancer({ frames: 60, seed: 16 });
  const once = solve({ ...made, positions: noisy(made.positions, 0.01) });
  const twice = solve(once);
  expect(twice.fitError).toBeLessThan(0.001);
  for (let i = 0; i < once.positions.length / 3; i++) {
    expect(Math.hypot(...sub(readVec(once.positions, i), readVec(twice.positions, i)))).toBeLessThan(0.004);
  }
});

test('69 seconds of dance are solved fast', () => {
  const made = madeDancer({ frames: 2066, seed: 17 });
  const clip = { ...made, positions: noisy(made.positions, 0.01) };
  solve(clip);
  const before = process.cpuUsage().user;
  solve(clip);
  // Time of the processor, not of the clock, and room for a slow one; about 0.12 s where this was written.
  expect((process.cpuUsage().user - before) / 1e6).toBeLessThan(0.6);
});
