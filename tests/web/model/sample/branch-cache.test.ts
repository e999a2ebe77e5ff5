import { expect, it } from 'vitest';
import { BranchCache } from '../../../../web/model/sample/branch-cache';

const array = (kilobytes: number): Float32Array => new Float32Array(kilobytes * 256);

it('drops the group used longest ago while there is too much', () => {
  const cache = new BranchCache<'a' | 'b'>(10 * 1024);
  cache.add('one', 'a', array(4));
  cache.add('two', 'a', array(4));
  cache.group('one');
  cache.add('three', 'a', array(4));
  expect(['one', 'two', 'three'].map((key) => cache.group(key).size)).toEqual([1, 0, 1]);
  expect(cache.bytes).toBe(8 * 1024);
});

it('keeps a group that is too large by itself, and nothing beside it', () => {
  const cache = new BranchCache<'a' | 'b'>(10 * 1024);
  cache.add('one', 'a', array(4));
  cache.add('two', 'a', array(8));
  cache.add('two', 'b', array(8));
  expect(cache.group('two').size).toBe(2);
  expect(cache.bytes).toBe(16 * 1024);
});
