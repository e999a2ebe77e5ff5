import { expect, test } from 'vitest';
import { checkPlausible } from '../../../../web/motion/skeleton/plausible';
import { JOINT_COUNT, SMPL22 } from '../../../../web/motion/skeleton/skeleton';

/** What is said of a clip of three frames, all of whose joints are at the origin but for one coordinate. */
function problemWith(value: number, frame: number, joint: number): string {
  const positions = new Float32Array(3 * JOINT_COUNT * 3);
  positions[(frame * JOINT_COUNT + joint) * 3] = value;
  try {
    checkPlausible({ fps: 30, positions, frames: 3 });
  } catch (error) {
    return (error as Error).message;
  }
  return '';
}

test('a joint without a place is said to be so, not to be far away', () => {
  const wrist = SMPL22.indexOf('left_wrist');
  for (const value of [NaN, Infinity, -Infinity])
    for (const frame of [0, 2])
      expect(problemWith(value, frame, wrist)).toBe(
        `A joint has no place: a coordinate of left_wrist in frame ${frame + 1} is not a finite number.`,
      );
});

test('a joint that is far away', () => {
  expect(problemWith(51, 0, 0)).toBe(
    'The dance is too far aside: pelvis in frame 1 is more than 50 m from the middle of the world.',
  );
  expect(problemWith(51, 1, 0)).toBe(
    'No dancer moves like this: pelvis in frame 2 is more than 50 m from the middle of the world.',
  );
  expect(problemWith(4, 1, 5)).toBe(
    `No dancer moves like this: ${SMPL22[5]} in frame 2 is more than 3 m from the pelvis.`,
  );
  expect(problemWith(2, 1, 5)).toBe('');
});
