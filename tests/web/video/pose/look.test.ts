import { describe, expect, test } from 'vitest';
import { KnownLook, lookOf } from '../../../../web/video/pose/look';
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

function expectColours(look: readonly number[], trunk: readonly number[], thighs: readonly number[]): void {
  [...trunk, ...thighs].forEach((value, i) => {
    expect(look[i]).toBeCloseTo(value, 5);
  });
}

test('a look has the colour of the trunk and of the thighs', () => {
  expectColours(lookOf(picture(RED, BLUE, 140), standing()), RED, BLUE);
});

test('what lies outside of the picture does not count', () => {
  const landmarks = standing();
  // The left side of the body is beyond the edge.
  for (const i of [11, 23, 25]) landmarks[5 * i] = LANDMARK_SIDE + 200;
  expectColours(lookOf(picture(RED, BLUE, 140), landmarks), RED, BLUE);
  landmarks.fill(-500);
  expectColours(lookOf(picture(RED, BLUE, 140), landmarks), [0, 0, 0], [0, 0, 0]);
});

describe('what a person looks like', () => {
  const own = [...RED, ...BLUE];
  const other = [...BLUE, ...RED];

  test('no look is strange until it is known', () => {
    const known = new KnownLook();
    known.learn(own);
    expect(known.strangeness(other)).toBe(0);
  });

  test('somebody else in other clothes looks strange, the person does not, in light and shade', () => {
    const known = new KnownLook();
    for (let i = 0; i < 40; i++) known.learn(own.map((value) => value * (i % 2 === 0 ? 0.85 : 1.15)));
    expect(known.strangeness(other)).toBeGreaterThan(2);
    expect(known.strangeness(own.map((value) => value * 0.8))).toBeLessThan(1);
  });

  test('light that changes slowly is learnt', () => {
    const known = new KnownLook();
    for (let i = 0; i < 20; i++) known.learn(own);
    const dim = own.map((value) => value * 0.6);
    const before = known.strangeness(dim);
    for (let i = 0; i < 100; i++) known.learn(dim);
    expect(before).toBeGreaterThan(1);
    expect(known.strangeness(dim)).toBeLessThan(0.3);
  });
});
