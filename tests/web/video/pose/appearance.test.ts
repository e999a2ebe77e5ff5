import { describe, expect, test } from 'vitest';
import { AppearanceModel, appearanceOf } from '../../../../web/video/pose/appearance';
import { LANDMARK_SIDE } from '../../../../web/video/pose/landmarks';

const RED = [0.8, 0.1, 0.1] as const;
const BLUE = [0.1, 0.1, 0.6] as const;

/** Landmarks of somebody who stands upright in the middle: shoulders, hips and knees. */
function standing(): Float32Array {
  const landmarks = new Float32Array(39 * 5);
  const places = {
    11: [150, 80],
    12: [106, 80],
    23: [145, 140],
    24: [111, 140],
    25: [145, 190],
    26: [111, 190],
  };
  for (const [i, place] of Object.entries(places)) landmarks.set(place, 5 * Number(i));
  return landmarks;
}

/** A picture that is `above` over a line and `below` under it. */
function picture(above: readonly number[], below: readonly number[], line: number): Float32Array {
  const pixels = LANDMARK_SIDE ** 2;
  return Float32Array.from({ length: 3 * pixels }, (_, i) => {
    const row = Math.floor((i % pixels) / LANDMARK_SIDE);
    return (row < line ? above : below)[Math.floor(i / pixels)]!;
  });
}

/** Mean colour of a picture of which a share is `above` and the rest `below`. */
const mean = (share: number): number[] => RED.map((red, i) => share * red + (1 - share) * BLUE[i]!);

/** Colours as shares of the mean colour about the person. */
function expectColours(
  appearance: readonly number[],
  parts: readonly (readonly number[])[],
  about: readonly number[],
): void {
  parts.flat().forEach((value, i) => {
    expect(appearance[i]).toBeCloseTo(value / about[i % 3]!, 2);
  });
}

const LINE = 140;
const ABOUT = mean(LINE / LANDMARK_SIDE);

test('an appearance has the colour of the trunk and of the thighs, as shares of the mean colour', () => {
  expectColours(appearanceOf(picture(RED, BLUE, LINE), standing()), [RED, BLUE], ABOUT);
});

test('what lies outside of the picture does not count', () => {
  const landmarks = standing();
  // The left side of the body is beyond the edge.
  for (const i of [11, 23, 25]) landmarks[5 * i] = LANDMARK_SIDE + 200;
  expectColours(appearanceOf(picture(RED, BLUE, LINE), landmarks), [RED, BLUE], ABOUT);
  landmarks.fill(-500);
  expect(appearanceOf(picture(RED, BLUE, LINE), landmarks)).toEqual([0, 0, 0, 0, 0, 0]);
  // Black beyond the edges of the video: 60 rows of it.
  const whole = picture(RED, BLUE, LINE);
  const cut = picture([0, 0, 0], [1, 1, 1], 60).map((inside, i) => inside * whole[i]!);
  expectColours(appearanceOf(cut, standing()), [RED, BLUE], mean((LINE - 60) / (LANDMARK_SIDE - 60)));
});

test('a person looks the same under a lamp of another colour, and in less light', () => {
  const day = picture(RED, BLUE, LINE);
  const own = appearanceOf(day, standing());
  const pixels = LANDMARK_SIDE ** 2;
  for (const lamp of [
    [1, 0.4, 0.3],
    [0.4, 0.5, 1],
    [0.5, 0.5, 0.5],
  ]) {
    const lit = day.map((value, i) => value * lamp[Math.floor(i / pixels)]!);
    appearanceOf(lit, standing()).forEach((value, i) => {
      expect(value).toBeCloseTo(own[i]!, 4);
    });
  }
});

describe('what a person looks like', () => {
  const own = [RED, BLUE].flatMap((part) => part.map((value, i) => value / ABOUT[i]!));
  const other = [...own.slice(3), ...own.slice(0, 3)];

  test('nobody differs from a person who is not known yet', () => {
    const model = new AppearanceModel();
    model.learn(own);
    expect(model.difference(other)).toBe(0);
  });

  test('somebody else in other clothes differs, the person does not, in light and shade', () => {
    const model = new AppearanceModel();
    for (let i = 0; i < 40; i++) model.learn(own.map((value) => value * (i % 2 === 0 ? 0.85 : 1.15)));
    expect(model.difference(other)).toBeGreaterThan(2);
    expect(model.difference(own.map((value) => value * 0.9))).toBeLessThan(1);
  });

  test('light that changes slowly is learnt', () => {
    const model = new AppearanceModel();
    for (let i = 0; i < 20; i++) model.learn(own);
    const dim = own.map((value) => value * 0.6);
    const before = model.difference(dim);
    for (let i = 0; i < 100; i++) model.learn(dim);
    expect(before).toBeGreaterThan(1);
    expect(model.difference(dim)).toBeLessThan(0.3);
  });
});
