import { describe, expect, test } from 'vitest';
import type { Answer } from '../../../../web/ui/study/answers';
import { summarise, wilson } from '../../../../web/ui/study/summary';

const answer = (left: string, right: string, score: number, more: Partial<Answer> = {}): Answer => ({
  ...{ participant: 'p', set: 's', seed: 1, pair: 1, duet: 'd', left, right, score, seconds: 3 },
  criterion: 'naturalness',
  ...more,
});

describe('the interval of a share', () => {
  test.each([
    // Values of R's prop.test(x, n, correct = FALSE).
    [8, 10, 0.4901625, 0.9433178],
    [45, 60, 0.6276759, 0.8422275],
    [0, 20, 0, 0.1611252],
    [15, 15, 0.7961107, 1],
  ])('%i of %i', (wins, n, low, high) => {
    const [a, b] = wilson(wins / n, n);
    expect(a).toBeCloseTo(low, 4);
    expect(b).toBeCloseTo(high, 4);
  });

  test('of nothing is everything', () => expect(wilson(NaN, 0)).toEqual([0, 1]));
});

describe('the summary', () => {
  test('counts for the method on whichever side it was', () => {
    const [one, ...others] = summarise(
      [
        answer('ours', 'edge', -2),
        answer('edge', 'ours', 1),
        answer('ours', 'edge', 0),
        answer('ours', 'edge', 1),
      ],
      'ours',
    );
    expect(others).toEqual([]);
    expect(one).toMatchObject({
      ...{ method: 'ours', against: 'edge', criterion: 'naturalness' },
      ...{ answers: 4, wins: 2, equal: 1, losses: 1, rate: 0.625, mean: 0.5 },
    });
    expect(one!.interval).toEqual(wilson(0.625, 4));
  });

  test('keeps criteria and opponents apart, the reference first', () => {
    const list = summarise(
      [
        answer('edge', 'ours', 2),
        answer('edge', 'ours', 2, { criterion: 'interaction' }),
        answer('ours', 'a', -1),
        answer('a', 'edge', -1),
      ],
      'ours',
    );
    expect(list.map(({ method, against, criterion }) => `${method} ${against} ${criterion}`)).toEqual([
      'ours a naturalness',
      'ours edge naturalness',
      'ours edge interaction',
      'a edge naturalness',
    ]);
    expect(list.map(({ rate }) => rate)).toEqual([1, 1, 1, 1]);
  });
});
