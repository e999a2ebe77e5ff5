import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import { leaderBvh } from '../../../support/leader-bvh';
import { writeBvh } from '../../../../../web/motion/bvh/write';
import { bodyHeight } from '../../../../../web/motion/skeleton/scale';
import { J, JOINT_COUNT, SMPL22 } from '../../../../../web/motion/skeleton/skeleton';
import { solve } from '../../../../../web/motion/fit/ik';
import { percentile } from '../../../../../web/motion/math/statistics';
import { distance, readVec } from '../../../../../web/motion/math/vec3';

const folder = fileURLToPath(new URL('../../../../../../shared/data/bvh/', import.meta.url));
const present = existsSync(folder);
const files = present ? readdirSync(folder).filter((name) => name.endsWith('.bvh')) : [];
const text = (file: string): string => readFileSync(folder + file, 'utf8');
/** The DAZ files state 120 frames per second and were recorded with 60. */
const trueRate = (file: string) => (file.includes('daz') ? { fps: 60 } : {});

if (!present) test.skip('recorded dances: real data not present', () => undefined);

describe.each(files)('%s', (file) => {
  const { clip, report } = leaderBvh(text(file), trueRate(file));
  const motion = solve(clip);

  test('is understood', () => {
    expect(report.convention).toBe(file.includes('daz') ? 'DAZ' : 'Character Creator');
    expect(report).toMatchObject({ unit: 'centimetres', upAxis: 'y', sourceFps: 60 });
    expect(report.estimated).toEqual(['pelvis', 'spine1', 'spine2', 'spine3']);
    const frames = Number(/^Frames:\s*(\d+)/m.exec(text(file))![1]);
    // Every second frame; before some dances stand a few frames of a rest pose, which are left out.
    expect(Math.abs(frames / 2 - clip.frames)).toBeLessThan(4);
    expect(bodyHeight(clip)).toBeGreaterThan(1.2);
    expect(bodyHeight(clip)).toBeLessThan(1.6);
  });

  test('stands on the floor, upright', () => {
    const heights = Array.from({ length: clip.frames }, (_, frame) => {
      const toe = (joint: number): number => clip.positions[(frame * JOINT_COUNT + joint) * 3 + 1]!;
      return Math.min(toe(J.left_foot), toe(J.right_foot));
    });
    expect(percentile(heights, 10)).toBeCloseTo(0.03, 4);
    expect(percentile(heights, 0)).toBeGreaterThan(-0.03);
    expect(readVec(clip.positions, J.head)[1]).toBeGreaterThan(1.2);
  });

  test('is solved to millimetres, and is the same after writing and reading', () => {
    expect(motion.fitError).toBeLessThan(0.005);
    const back = leaderBvh(writeBvh(motion)).clip;
    for (let i = 0; i < motion.positions.length / 3; i++) {
      expect(distance(readVec(back.positions, i), readVec(motion.positions, i))).toBeLessThan(1e-4);
    }
  });
});

test.runIf(present)('the rate that a header states wrongly is noticed', () => {
  const { report } = leaderBvh(text('cmu_60_10_daz.bvh'));
  expect(report.sourceFps).toBe(120);
  expect(report.warnings.join()).toMatch(/frame rate of the file \(120\) is wrong/);
  expect(leaderBvh(text('cmu_60_10_daz.bvh'), { fps: 60 }).report.warnings).toEqual([]);
});

test.runIf(present)('a T-pose at the beginning is not danced', () => {
  for (const file of files) {
    const { clip, report } = leaderBvh(text(file), trueRate(file));
    const daz = file.includes('daz');
    expect(report.remarks.join()).toMatch(
      daz ? /^The first frame is a rest pose and is left out, with the 3 after/ : /^$/,
    );
    const speeds = SMPL22.map(
      (_, joint) =>
        30 * distance(readVec(clip.positions, joint), readVec(clip.positions, JOINT_COUNT + joint)),
    );
    expect(Math.max(...speeds)).toBeLessThan(daz ? 2 : 5);
  }
});

test.runIf(present)('leader and reactor of one dance keep their distance', () => {
  const [leader, reactor] = ['cmu_60_10_daz.bvh', 'cmu_61_10_daz.bvh'].map((file) =>
    leaderBvh(text(file), { fps: 60 }),
  );
  const apart = Array.from({ length: leader!.clip.frames }, (_, frame) => {
    const [a, b] = [leader!, reactor!].map(({ clip }) => readVec(clip.positions, frame * JOINT_COUNT));
    return Math.hypot(a![0] - b![0], a![2] - b![2]);
  });
  expect(percentile(apart, 50)).toBeGreaterThan(0.5);
  expect(percentile(apart, 50)).toBeLessThan(1);
});
