import { expect, it } from 'vitest';
import { RecentCache } from '../../../web/common/recent-cache';

it('keeps the values that were used last', () => {
  const cache = new RecentCache<string, number>(2);
  cache.set('a', 1);
  cache.set('b', 2);
  expect(cache.get('a')).toBe(1);
  cache.set('c', 3);
  expect(['a', 'b', 'c'].map((key) => cache.get(key))).toEqual([1, undefined, 3]);
  cache.set('c', 4);
  expect(['a', 'c'].map((key) => cache.get(key))).toEqual([1, 4]);
});
