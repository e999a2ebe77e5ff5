import { describe, expect, test } from 'vitest';
import { leaderBvh } from '../../../support/leader-bvh';
import { type MadeJoint, madeBody, madeBvh, MIXAMO } from '../../../support/made-bvh';

const LEFT_OUT = 'The first frame is a rest pose and is left out.';
const body = madeBody(MIXAMO);
const dance = madeBvh({ joints: body, frames: 60 }).text;

/** Columns of a joint's Z rotation in a made file: those of the root's position come first. */
const column = (joints: readonly MadeJoint[], name: string): number =>
  3 + 3 * orderOf(joints).indexOf(`mixamorig:${name}`);

/** Joints as a made file has them: depth first. */
function orderOf(joints: readonly MadeJoint[], parent: string | null = null): string[] {
  return joints
    .filter((joint) => joint.parent === parent)
    .flatMap(({ name }) => [name, ...orderOf(joints, name)]);
}

/** Values of a frame: the root's place, and Z rotations of some joints, degrees. */
function pose(
  joints: readonly MadeJoint[],
  place: readonly [number, number, number],
  turns: Readonly<Record<string, number>> = {},
): number[] {
  const values = new Array<number>(3 + 3 * joints.length).fill(0);
  place.forEach((value, axis) => (values[axis] = value));
  for (const [name, degrees] of Object.entries(turns)) values[column(joints, name)] = degrees;
  return values;
}

const framesOf = (text: string): number[][] =>
  text
    .slice(text.indexOf('Frame Time'))
    .split('\n')
    .slice(1)
    .filter((line) => line !== '')
    .map((line) => line.split(' ').map(Number));

/** A file with other frames. */
function withFrames(text: string, frames: readonly (readonly number[])[]): string {
  const head = text.slice(0, text.indexOf('MOTION'));
  const lines = frames.map((values) => values.join(' '));
  return [`${head}MOTION`, `Frames: ${frames.length}`, 'Frame Time: 0.0333333', ...lines, ''].join('\n');
}

const before = (text: string, ...frames: readonly (readonly number[])[]): string =>
  withFrames(text, [...frames, ...framesOf(text)]);

describe('a rest pose before the dance is left out', () => {
  const expectLeftOut = (text: string, plain: string): void => {
    const [read, meant] = [leaderBvh(text), leaderBvh(plain)];
    expect(read.report.remarks).toEqual([LEFT_OUT]);
    expect(read.report.warnings).toEqual([]);
    expect(read.clip.positions).toEqual(meant.clip.positions);
    expect(meant.report.remarks).toEqual([]);
  };

  test('at the place where the dance begins', () =>
    expectLeftOut(before(dance, pose(body, [0, 95, 18])), dance));

  test('at another place, rotated, with slightly bent limbs', () => {
    const bent = pose(body, [300, 90, -200], { LeftArm: 6, RightUpLeg: -5, LeftForeArm: 4 });
    bent[5] = 140;
    expectLeftOut(before(dance, bent), dance);
  });

  test('with the arms hanging down, as the skeleton of the file has them', () => {
    const hanging = body.map((joint) =>
      /ForeArm|Hand/.test(joint.name)
        ? { ...joint, offset: [joint.offset[0] / 4, -0.25, 0] as const }
        : joint,
    );
    const text = madeBvh({ joints: hanging, frames: 60 }).text;
    expectLeftOut(before(text, pose(hanging, [40, 95, 40])), text);
    const raised = pose(hanging, [40, 95, 40], { LeftArm: 75, RightArm: -75 });
    expectLeftOut(before(text, raised), text);
    const turned = pose(hanging, [40, 95, 40]);
    turned[5] = 140;
    expectLeftOut(before(text, turned), text);
    const half = pose(hanging, [40, 95, 40], { LeftArm: 40, RightArm: -40 });
    expect(leaderBvh(before(text, half)).report.remarks).toEqual([]);
  });

  test('with the fast frames in which a solver moves out of it', () => {
    // The arms are down from the first frame of the dance on, which then hardly moves.
    const calm = framesOf(madeBvh({ joints: body, frames: 60, swing: 1 }).text).map((values) => {
      values[column(body, 'LeftArm')]! -= 75;
      values[column(body, 'RightArm')]! += 75;
      return values;
    });
    const [first] = calm as [number[]];
    const rest = pose(body, [90, 95, 100]);
    const way = [0.8, 0.93, 0.99].map((part) => rest.map((value, i) => value + part * (first[i]! - value)));
    for (const [count, landing] of [
      [3, 'the 2 after it'],
      [2, 'the next one'],
    ] as const) {
      const read = leaderBvh(withFrames(dance, [rest, ...way.slice(3 - count), ...calm]));
      expect(read.report.remarks).toEqual([
        `The first frame is a rest pose and is left out, with ${landing}, in which the body jumps from it into the dance.`,
      ]);
      expect(read.clip.frames).toBe(61);
    }
  });
});

describe('no frame is left out of a dance', () => {
  const remarks = (text: string): readonly string[] => leaderBvh(text).report.remarks;

  test('that begins in a T-pose, however quickly', () => {
    const rest = pose(body, [0, 95, 18]);
    /** The arms fall by 80 degrees in `count` frames, at once at full speed or faster and faster. */
    const falling = (count: number, speed: (part: number) => number): number[][] =>
      Array.from({ length: 60 }, (_, frame) => {
        const angle = 80 * speed(Math.min(1, frame / count));
        return rest.map((value, i) =>
          i === column(body, 'LeftArm') ? -angle : i === column(body, 'RightArm') ? angle : value,
        );
      });
    for (const count of [4, 8, 20]) {
      expect(
        remarks(
          withFrames(
            dance,
            falling(count, (part) => part),
          ),
        ),
      ).toEqual([]);
      expect(
        remarks(
          withFrames(
            dance,
            falling(count, (part) => part ** 2),
          ),
        ),
      ).toEqual([]);
      expect(
        remarks(
          withFrames(
            dance,
            falling(count, (part) => Math.sin((part * Math.PI) / 2)),
          ),
        ),
      ).toEqual([]);
    }
  });

  test('that begins with a jump out of another pose', () => {
    const raised = pose(body, [0, 95, 18], { LeftArm: 80, RightArm: -80 });
    expect(remarks(before(dance, raised))).toEqual([]);
    const sitting = pose(body, [0, 95, 18]);
    sitting[column(body, 'LeftUpLeg') + 1] = -90;
    expect(remarks(before(dance, sitting))).toEqual([]);
  });

  test('that has as large jumps later on', () => {
    const rest = pose(body, [0, 95, 18]);
    const frames = framesOf(dance);
    const jumping = frames.map((values, i) =>
      values.map((value, at) => (at < 3 && i >= 20 ? value + 40 : value)),
    );
    expect(remarks(withFrames(dance, [rest, ...jumping]))).toEqual([]);
  });

  test('that stands still after a small step', () => {
    const frames = Array.from({ length: 60 }, (_, frame) => pose(body, [frame === 0 ? 0 : 2, 95, 18]));
    expect(remarks(withFrames(dance, frames))).toEqual([]);
  });

  test('that is too short to compare', () => {
    const frames = framesOf(dance).slice(0, 12);
    expect(remarks(withFrames(dance, [pose(body, [0, 95, 18]), ...frames]))).toEqual([]);
  });
});
