import { describe, expect, it } from 'vitest';
import { stepCounts } from '../../../../web/motion/beats/step-timing';
import { besidePartner } from '../../../../web/motion/contact/beside-partner';
import { holdHands } from '../../../../web/motion/contact/hand-hold';
import { aboutAxis, multiply, writeQuat } from '../../../../web/motion/math/quat';
import { add, direction, distance, scale, sub, type Vec3, writeVec } from '../../../../web/motion/math/vec3';
import type { MotionClip, SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { J, JOINT_COUNT, MIRROR } from '../../../../web/motion/skeleton/skeleton';
import { at, expectSound, moves, top } from '../../support/moved-joints';
import { eased, madeStander } from '../../support/made-stander';
import { small } from '../../support/small-manifest';

const FRAMES = 150;
const ARMS = [J.left_elbow, J.right_elbow, J.left_wrist, J.right_wrist];
const HAND = 0.15;

interface Pose {
  /** Turn of the arm from the side to the front, and bend of the elbow, radians. */
  readonly forward: number;
  readonly elbow?: number;
  /** Turn of the arm upwards, radians. */
  readonly up?: number;
}

/** A stander with arms held like this; the right one mirrors the left. */
function dancer(pose: (frame: number) => Pose): SolvedMotion {
  const still = madeStander({ frames: FRAMES });
  const rotations = still.rotations.slice();
  for (let frame = 0; frame < FRAMES; frame++)
    for (const [side, shoulder, elbow] of [
      [1, J.left_shoulder, J.left_elbow],
      [-1, J.right_shoulder, J.right_elbow],
    ] as const) {
      const { forward, elbow: bend = 0.6, up = 0 } = pose(frame);
      const turn = multiply(aboutAxis([0, 1, 0], -side * forward), aboutAxis([0, 0, 1], side * up));
      writeQuat(rotations, frame * JOINT_COUNT + shoulder, turn);
      writeQuat(rotations, frame * JOINT_COUNT + elbow, aboutAxis([0, 1, 0], -side * bend));
    }
  return { ...still, rotations, positions: forwardKinematics(still.offsets, still.root, rotations) };
}

/** Someone in the same pose who stands opposite, so far away. */
function opposite({ positions, frames, fps }: MotionClip, away: number): MotionClip {
  const turned = positions.map((value, i) => (i % 3 === 0 ? -value : i % 3 === 2 ? away - value : value));
  return { frames, fps, positions: turned };
}

function handOf({ positions }: MotionClip, frame: number, elbow: number, wrist: number): Vec3 {
  const joint = (which: number): Vec3 => {
    const i = 3 * (frame * JOINT_COUNT + which);
    return [positions[i]!, positions[i + 1]!, positions[i + 2]!];
  };
  return add(joint(wrist), scale(direction(sub(joint(wrist), joint(elbow)), [0, 0, 0]), HAND));
}

/** The way from the partner's right hand to the dancer's left hand in each frame, metres. */
function ways(motion: MotionClip, partner: MotionClip): Vec3[] {
  return Array.from({ length: motion.frames }, (_, frame) =>
    sub(
      handOf(motion, frame, J.left_elbow, J.left_wrist),
      handOf(partner, frame, J.right_elbow, J.right_wrist),
    ),
  );
}

const gaps = (motion: MotionClip, partner: MotionClip): number[] =>
  ways(motion, partner).map((way) => Math.hypot(...way));

/** Greatest step of the way between two hands from one frame to the next, in the middle of the dance, metres. */
function drift(motion: MotionClip, partner: MotionClip): number {
  const all = ways(motion, partner).slice(40, -40);
  return top(all.slice(1).map((way, i) => distance(way, all[i]!)));
}

/** Someone whose right hand stays at this point, and whose left arm is far away. */
function withHandAt(point: Vec3): MotionClip {
  const positions = new Float32Array(FRAMES * JOINT_COUNT * 3).fill(10);
  for (let frame = 0; frame < FRAMES; frame++) {
    writeVec(positions, frame * JOINT_COUNT + J.right_elbow, add(point, [0, 0, HAND + 0.25]));
    writeVec(positions, frame * JOINT_COUNT + J.right_wrist, add(point, [0, 0, HAND]));
  }
  return { frames: FRAMES, fps: 30, positions };
}

const POSE: Pose = { forward: 1.2 };
const still = dancer(() => POSE);
const bent = dancer(() => ({ forward: 1.2, elbow: 1 }));
/** How far apart two dancers stand whose hands are so far apart. */
const apart = (gap: number): number => 2 * handOf(still, 0, J.left_elbow, J.left_wrist)[2] + gap;
/** Hands that drift to and fro by some centimetres, one and a half times a second. */
const drifting = dancer((frame) => ({ ...POSE, up: 0.15 * Math.sin((2 * Math.PI * frame) / 20) }));

describe('holdHands', () => {
  it('lets hands go with the hands of the partner that they drift about', () => {
    const partner = opposite(still, apart(0.12));
    expect(top(gaps(drifting, partner).slice(40, -40))).toBeGreaterThan(0.13);
    const held = holdHands(drifting, partner);
    expect(top(gaps(held, partner).slice(40, -40))).toBeLessThan(0.11);
    expect(drift(held, partner)).toBeLessThan(0.35 * drift(drifting, partner));
    expectSound(drifting, held, ARMS);
  });

  it('steadies hands that are in each other already', () => {
    const partner = opposite(still, apart(0.02));
    const little = dancer((frame) => ({ ...POSE, up: 0.06 * Math.sin((2 * Math.PI * frame) / 20) }));
    expect(drift(holdHands(little, partner), partner)).toBeLessThan(0.5 * drift(little, partner));
  });

  it('brings a hand between both hands of the partner where both are near', () => {
    const near = dancer(() => ({ forward: 1.2, elbow: 1.25 }));
    const [across, , front] = handOf(near, 75, J.left_elbow, J.left_wrist);
    expect(Math.abs(across)).toBeLessThan(0.03);
    const partner = opposite(near, 2 * front + 0.12);
    for (const [, , behind] of ways(holdHands(near, partner), partner).slice(40, -40)) {
      expect(behind).toBeLessThan(-0.005);
      expect(behind).toBeGreaterThan(-0.09);
    }
  });

  it('follows a hand of the partner that moves', () => {
    const moving = dancer((frame) => ({ ...POSE, up: 0.3 * Math.sin((2 * Math.PI * frame) / 75) }));
    const partner = opposite(moving, apart(0.05));
    const held = holdHands(still, partner);
    expect(top(gaps(still, partner).slice(40, -40))).toBeGreaterThan(0.13);
    expect(top(gaps(held, partner).slice(40, -40))).toBeLessThan(0.1);
    expectSound(still, held, ARMS);
  });

  it.each([
    [0.03, 0],
    [0.1, 0.05],
    [0.2, 0.15],
    // Halfway between the distances of hands that hold and that do not: half of the way to a grip.
    [0.275, 0.225 / 2],
    [0.35, 0],
  ])('brings a hand that rests %f m from the hand of the partner nearer by %f m', (away, nearer) => {
    const held = holdHands(bent, withHandAt(add(handOf(bent, 0, J.left_elbow, J.left_wrist), [0, away, 0])));
    for (const move of moves(bent, held, J.left_wrist)) expect(move).toBeCloseTo(nearer, 4);
  });

  it('leaves hands that are far from those of the partner', () => {
    const held = holdHands(drifting, opposite(still, apart(0.6)));
    expect(held.rotations).toEqual(drifting.rotations);
    expect(held.positions).toEqual(drifting.positions);
  });

  it('does not hold hands that only pass each other', () => {
    // From beside the body to beside the body, past the partner's hands, within a third of a second.
    const passing = dancer((frame) => ({ forward: 1.2, up: 1.4 - 2.8 * eased(frame, 70, 80) }));
    const partner = opposite(still, apart(0.05));
    const held = holdHands(passing, partner);
    const steps = (motion: SolvedMotion): number[] =>
      Array.from({ length: FRAMES - 1 }, (_, t) =>
        distance(at(motion, t, J.left_wrist), at(motion, t + 1, J.left_wrist)),
      );
    expect(top(steps(held))).toBeLessThan(1.1 * top(steps(passing)));
    expect(top(moves(passing, held, J.left_wrist).slice(0, 40))).toBeLessThan(1e-3);
  });

  it('lets go of a hand that swings away, without a jump', () => {
    const swinging = dancer((frame) => ({ ...POSE, up: 1.2 * eased(frame, 70, 75) }));
    const partner = opposite(swinging, apart(0.05));
    const held = holdHands(still, partner);
    expect(top(moves(still, held, J.left_wrist).slice(100))).toBeLessThan(0.01);
    const steps = Array.from({ length: FRAMES - 1 }, (_, t) =>
      distance(at(held, t, J.left_wrist), at(held, t + 1, J.left_wrist)),
    );
    const theirs = Array.from({ length: FRAMES - 1 }, (_, t) =>
      distance(at(swinging, t, J.left_wrist), at(swinging, t + 1, J.left_wrist)),
    );
    expect(top(steps)).toBeLessThan(top(theirs));
  });

  it('does not follow a hand that beats to and fro', () => {
    const beating = dancer((frame) => ({ ...POSE, up: 0.9 * Math.sin((2 * Math.PI * frame) / 24) }));
    const held = holdHands(still, opposite(beating, apart(0.02)));
    expect(top(moves(still, held, J.left_wrist))).toBeLessThan(0.2);
  });

  it('does not jerk where a hand of the partner jerks', () => {
    const jerking = dancer((frame) => ({ ...POSE, up: frame === 75 ? 0.2 : 0 }));
    const held = holdHands(still, opposite(jerking, apart(0.05)));
    const away = moves(still, held, J.left_wrist);
    const before = away[40]!;
    expect(distance(at(jerking, 75, J.left_wrist), at(jerking, 74, J.left_wrist))).toBeGreaterThan(0.09);
    expect(top(away.map((value) => Math.abs(value - before)))).toBeLessThan(0.03);
  });

  it('leaves folded arms, which a small shift would swing round the shoulder', () => {
    const folded = dancer(() => ({ forward: 1.2, elbow: 2.6 }));
    const there = handOf(folded, 0, J.left_elbow, J.left_wrist);
    const partner = opposite(folded, 2 * there[2] + 0.1);
    expect(top(gaps(folded, partner))).toBeLessThan(0.2);
    const held = holdHands(folded, partner);
    for (const joint of ARMS) expect(top(moves(folded, held, joint))).toBeLessThan(1e-6);
  });

  it('does not fold an arm towards a hand that is near its shoulder', () => {
    const [hand, shoulder] = [handOf(bent, 0, J.left_elbow, J.left_wrist), at(bent, 0, J.left_shoulder)];
    const way = scale(direction(sub(shoulder, hand), [0, 0, 0]), 0.25);
    const held = holdHands(bent, withHandAt(add(hand, way)));
    // An arm that stayed open would go by 0.15 m.
    expect(top(moves(bent, held, J.left_wrist))).toBeLessThan(0.08);
  });

  it('stretches an arm no farther than it reaches', () => {
    // Nearly straight arms, and a partner who is still somewhat too far away.
    const straight = dancer((frame) => ({ forward: 1.2, elbow: 0.25 + 0.2 * Math.sin(frame / 6) }));
    const partner = opposite(
      dancer(() => ({ forward: 1.2, elbow: 0.05 })),
      apart(0.42),
    );
    const held = holdHands(straight, partner);
    expectSound(straight, held, ARMS);
    const lengths = Array.from({ length: FRAMES }, (_, t) =>
      distance(at(held, t, J.left_wrist), at(held, t, J.left_shoulder)),
    );
    const bone = (from: number, to: number): number => distance(at(held, 0, from), at(held, 0, to));
    const whole = bone(J.left_shoulder, J.left_elbow) + bone(J.left_elbow, J.left_wrist);
    expect(top(lengths)).toBeLessThan(whole);
    const steps = lengths.slice(1).map((value, t) => Math.abs(value - lengths[t]!));
    expect(top(steps)).toBeLessThan(0.02);
  });

  it('treats left and right alike', () => {
    const partner = opposite(still, apart(0.12));
    const held = holdHands(drifting, partner);
    for (let frame = 0; frame < FRAMES; frame += 10)
      for (const joint of ARMS) {
        const [x, y, z] = at(held, frame, joint);
        expect(distance(at(held, frame, MIRROR[joint]!), [-x, y, z])).toBeLessThan(1e-5);
      }
  });

  it('moves a part of a dance as in the whole, but for one and a half seconds at its ends', () => {
    const partner = opposite(still, apart(0.12));
    const cut = <T extends MotionClip>(clip: T, from: number, to: number): T => {
      const rows = (values: Float32Array): Float32Array => {
        const width = values.length / clip.frames;
        return values.slice(from * width, to * width);
      };
      const parts = Object.entries(clip).map(([key, value]: [string, unknown]): [string, unknown] => [
        key,
        value instanceof Float32Array && key !== 'offsets' ? rows(value) : value,
      ]);
      return { ...(Object.fromEntries(parts) as unknown as T), frames: to - from };
    };
    const whole = cut(holdHands(drifting, partner), 65, 85);
    const part = cut(holdHands(cut(drifting, 20, 130), cut(partner, 20, 130)), 45, 65);
    for (const joint of ARMS) expect(top(moves(whole, part, joint))).toBeLessThan(1e-6);
  });

  it('belongs to what a dancer keeps to beside a partner', () => {
    const partner = opposite(still, apart(0.12));
    const kept = besidePartner(drifting, partner, small.quality, stepCounts([], drifting.frames, 30));
    expect(drift(kept, partner)).toBeLessThan(0.4 * drift(drifting, partner));
  });
});
