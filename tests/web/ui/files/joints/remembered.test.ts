import { describe, expect, test } from 'vitest';
import { RememberedJointsStorage } from '../../../../../web/ui/files/joints/remembered';

/** A localStorage in memory. @param room characters that fit */
function memory(room = Infinity): Pick<Storage, 'getItem' | 'setItem'> {
  const all = new Map<string, string>();
  return {
    getItem: (key) => all.get(key) ?? null,
    setItem: (key, value) => {
      if (value.length > room) throw new DOMException('full', 'QuotaExceededError');
      all.set(key, value);
    },
  };
}

describe('joints that are remembered', () => {
  test('by skeleton, between visits, until they are forgotten', () => {
    const storage = memory();
    const first = new RememberedJointsStorage(() => storage);
    first.remember('22-a', { head: 'Kopf' });
    first.remember('30-b', { head: null });
    const next = new RememberedJointsStorage(() => storage);
    expect(next.read()).toEqual({ '22-a': { head: 'Kopf' }, '30-b': { head: null } });
    next.remember('22-a', { head: 'Hals' });
    expect(first.read()['22-a']).toEqual({ head: 'Hals' });
    next.remember('22-a', null);
    expect(first.read()).toEqual({ '30-b': { head: null } });
  });

  test('the oldest skeletons leave first', () => {
    const storage = memory();
    const remembered = new RememberedJointsStorage(() => storage);
    for (let i = 0; i < 50; i++) remembered.remember(`skeleton ${i}`, { head: 'Kopf' });
    // Chosen again, the first one is the newest.
    remembered.remember('skeleton 0', { head: 'Hals' });
    remembered.remember('another', { head: 'Kopf' });
    const left = remembered.read();
    expect(Object.keys(left)).toHaveLength(50);
    expect(left['skeleton 0']).toEqual({ head: 'Hals' });
    expect(left['skeleton 1']).toBeUndefined();
  });

  test.each([
    [
      'forbidden',
      () => {
        throw new DOMException('forbidden', 'SecurityError');
      },
    ],
    ['not ours', () => ({ getItem: () => 'no JSON', setItem: () => undefined })],
    ['a list', () => ({ getItem: () => '[1]', setItem: () => undefined })],
  ])('storage that is %s reads as nothing, without an error', (_, storage) => {
    const remembered = new RememberedJointsStorage(storage);
    remembered.remember('22-a', { head: 'Kopf' });
    expect(remembered.read()).toEqual({});
  });

  test('a full storage keeps what was there', () => {
    const storage = memory(40);
    const remembered = new RememberedJointsStorage(() => storage);
    remembered.remember('22-a', { head: 'Kopf' });
    remembered.remember('22-b', { head: 'Kopf', neck: 'Hals' });
    expect(remembered.read()).toEqual({ '22-a': { head: 'Kopf' } });
  });
});
