import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { yieldToPage } from '../../../../web/common/yield-to-events';
import { Autosave } from '../../../../web/ui/project/autosave';
import type { StoredProject } from '../../../../web/ui/project/stored-project';
import type { TabLockApis } from '../../../../web/ui/project/tab-lock';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it('goes on when the other tab ends, also where what that has written cannot be read', async () => {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(30)));
  const inputs = currentInputs(store.getState())!;
  const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
  change.apply(store, change.reactionAdded(reaction, { id: 'a', at: 1e6 }));
  /** Ends the other tab, which has the right to write. */
  let end = (): void => undefined;
  const request = (...[, options, held]: Parameters<LockManager['request']>) =>
    options.ifAvailable
      ? held(null)
      : new Promise<void>((resolve) => (end = resolve)).then(() => held({} as Lock));
  const tabs = { name: 'tabs', locks: { request } as unknown as TabLockApis['locks'], channel: undefined };
  const written: string[][] = [];
  const storage = {
    read: () => Promise.resolve(null),
    write: ({ takes }: StoredProject) => Promise.resolve(void written.push(takes.map(({ id }) => id))),
    removeOwn: () => Promise.resolve(),
    clear: () => Promise.resolve(),
  };
  const autosave = new Autosave(store, storage, tabs, {
    merge: () => Promise.reject(new Error('Nothing can be read.')),
    framing: () => null,
    takeStored: () => undefined,
  });
  await autosave.read();
  autosave.start();
  await vi.advanceTimersByTimeAsync(1000);
  expect(store.getState().autosave).toBe('elsewhere');
  expect(written).toEqual([]);
  end();
  await vi.advanceTimersByTimeAsync(0);
  await yieldToPage();
  await vi.advanceTimersByTimeAsync(0);
  expect(written).toEqual([['a']]);
  expect(store.getState().autosave).toBe('stored');
  autosave.dispose();
});
