import { expect, it } from 'vitest';
import { BranchCache } from '../../../../web/model/sample/branch-cache';

const array = (kilobytes: number): Float32Array => new Float32Array(kilobytes * 256);

it('drops the group used longest ago while there is too much', () => {
  const cache = new BranchCache<'a' | 'b'>(10 * 1024);
  cache.add(1, 'a', array(4));
  cache.add(2, 'a', array(4));
  cache.group(1);
  cache.add(3, 'a', array(4));
  expect([1, 2, 3].map((seed) => cache.group(seed).size)).toEqual([1, 0, 1]);
  expect(cache.bytes).toBe(8 * 1024);
});

it('keeps a group that is too large by itself, and nothing beside it', () => {
  const cache = new BranchCache<'a' | 'b'>(10 * 1024);
  cache.add(1, 'a', array(4));
  cache.add(2, 'a', array(8));
  cache.add(2, 'b', array(8));
  expect(cache.group(2).size).toBe(2);
  expect(cache.bytes).toBe(16 * 1024);
});
