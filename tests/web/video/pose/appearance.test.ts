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

function expectColours(
  appearance: readonly number[],
  trunk: readonly number[],
  thighs: readonly number[],
): void {
  [...trunk, ...thighs].forEach((value, i) => {
    expect(appearance[i]).toBeCloseTo(value, 5);
  });
}

test('an appearance has the colour of the trunk and of the thighs', () => {
  expectColours(appearanceOf(picture(RED, BLUE, 140), standing()), RED, BLUE);
});

test('what lies outside of the picture does not count', () => {
  const landmarks = standing();
  // The left side of the body is beyond the edge.
  for (const i of [11, 23, 25]) landmarks[5 * i] = LANDMARK_SIDE + 200;
  expectColours(appearanceOf(picture(RED, BLUE, 140), landmarks), RED, BLUE);
  landmarks.fill(-500);
  expectColours(appearanceOf(picture(RED, BLUE, 140), landmarks), [0, 0, 0], [0, 0, 0]);
});

describe('what a person looks like', () => {
  const own = [...RED, ...BLUE];
  const other = [...BLUE, ...RED];

  test('nobody differs from a person who is not known yet', () => {
    const model = new AppearanceModel();
    model.learn(own);
    expect(model.difference(other)).toBe(0);
  });

  test('somebody else in other clothes differs, the person does not, in light and shade', () => {
    const model = new AppearanceModel();
    for (let i = 0; i < 40; i++) model.learn(own.map((value) => value * (i % 2 === 0 ? 0.85 : 1.15)));
    expect(model.difference(other)).toBeGreaterThan(2);
    expect(model.difference(own.map((value) => value * 0.8))).toBeLessThan(1);
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
