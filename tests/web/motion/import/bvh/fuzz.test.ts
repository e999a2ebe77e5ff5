import { expect, test } from 'vitest';
import { AppError } from '../../../../../web/common/error';
import { leaderBvh } from '../../../support/leader-bvh';
import { processorTimer } from '../../../support/processor-time';
import { fuzz } from '../../../support/hostile/fuzz';
import { madeBody, madeBvh, MIXAMO } from '../../../support/made-bvh';
import { damagedText, MAX_CASE_SECONDS } from '../../../support/hostile/mutations';

const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 6 });

function problemOf(bvh: string): AppError {
  const seconds = processorTimer();
  try {
    leaderBvh(bvh);
  } catch (error) {
    expect(seconds()).toBeLessThan(MAX_CASE_SECONDS);
    if (error instanceof AppError) return error;
    throw error;
  }
  throw new Error('the file was read');
}

test('a damaged BVH file is read as a possible dance or refused in a sentence', { timeout: 600_000 }, () => {
  const { read, refused } = fuzz(
    (random) => damagedText(text, random),
    (bvh) => leaderBvh(bvh).clip,
    ({ frames, positions }) => {
      expect(frames).toBeGreaterThan(1);
      expect(positions.every((value) => Math.abs(value) <= 53)).toBe(true);
    },
  );
  expect(Math.min(read, refused)).toBeGreaterThan(0);
});

test('coordinates of kilometres are refused', () => {
  const lines = text.split('\n');
  const frame = lines.findLastIndex((line) => line.trim() !== '');
  lines[frame] = lines[frame]!.replace(/^\S+/, '300000');
  expect(problemOf(lines.join('\n')).message).toMatch(/in frame 6 is more than 50 m/);
});

test('a million nested joints, 20,000 joints and 60,000 frames of 400 joints are refused at once', () => {
  const joint = 'JOINT a\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n';
  const root = 'HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n';
  expect(problemOf(root + joint.repeat(1e6)).message).toContain('more than 1000 joints');
  expect(problemOf(`${root}${`${joint}}\n`.repeat(20_000)}}\nMOTION\n`).message).toContain('1000 joints');
  const row = `${'0 '.repeat(1200)}\n`;
  const wide = `${root}${`${joint}}\n`.repeat(400)}}\nMOTION\nFrames: 60000\nFrame Time: 0.03\n`;
  expect(problemOf(wide + row.repeat(60_000)).code).toBe('too-long');
});
