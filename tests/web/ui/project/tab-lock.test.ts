import { expect, it } from 'vitest';
import { TabLock, type TabLockApis } from '../../../../web/ui/project/tab-lock';

/** Web Locks of several tabs, as far as one lock needs them. */
class OneLock {
  private holder: { readonly end: () => void } | null = null;
  private readonly queue: (() => void)[] = [];

  readonly request = ((_: string, options: LockOptions, held: (lock: Lock | null) => unknown) =>
    new Promise<unknown>((resolve, reject) => {
      const grant = (): void => {
        const mine = { end: () => reject(new DOMException('Stolen.', 'AbortError')) };
        this.holder = mine;
        void Promise.resolve(held({} as Lock)).then((value) => {
          if (this.holder === mine) this.holder = null;
          resolve(value);
          if (!this.holder) this.queue.shift()?.();
        });
      };
      options.signal?.addEventListener('abort', () => {
        this.queue.splice(this.queue.indexOf(grant), 1);
        reject(new DOMException('Aborted.', 'AbortError'));
      });
      if (options.steal) {
        this.holder?.end();
        grant();
      } else if (!this.holder) grant();
      else if (options.ifAvailable) resolve(held(null));
      else this.queue.push(grant);
    })) as unknown as LockManager['request'];
}

/** Tabs that share a lock and a channel; `log` says what happened to each. */
function tabs(names: readonly string[], needed: Set<string>) {
  const lock = new OneLock();
  const listeners: { readonly of: string; readonly hear: () => void }[] = [];
  const log: string[] = [];
  const all = names.map((name) => {
    const means: TabLockApis = {
      name: 'tabs',
      locks: lock,
      channel: {
        postMessage: () => {
          for (const { of, hear } of listeners) if (of !== name) hear();
        },
        addEventListener: (_: string, hear: () => void) => void listeners.push({ of: name, hear }),
        close: () => undefined,
      } as unknown as BroadcastChannel,
    };
    return new TabLock(means, {
      gained: () => log.push(`${name} gains`),
      lost: () => log.push(`${name} loses`),
      needed: () => needed.has(name),
    });
  });
  return { all, log };
}

const settle = () => new Promise((resolve) => setTimeout(resolve, 0));

it('one tab has the right, the next one gets it when the first ends, or takes it', async () => {
  const { all, log } = tabs(['one', 'two'], new Set(['one', 'two']));
  const [one, two] = [all[0]!, all[1]!];
  await one.takeIfFree();
  await two.takeIfFree();
  expect([one.held, two.held]).toEqual([true, false]);
  two.wait();
  await settle();
  expect(two.held).toBe(false);
  await two.takeOver();
  await settle();
  expect([one.held, two.held]).toEqual([false, true]);
  expect(log.toSorted()).toEqual(['one loses', 'two gains']);
  one.wait();
  await settle();
  two.dispose();
  await settle();
  expect([one.held, two.held]).toEqual([true, false]);
  expect(log.at(-1)).toBe('one gains');
});

it('a tab that has taken the right no longer waits for it', async () => {
  const { all, log } = tabs(['one', 'two'], new Set(['one', 'two']));
  const [one, two] = [all[0]!, all[1]!];
  await one.takeIfFree();
  two.wait();
  await two.takeOver();
  two.giveBack();
  await settle();
  expect([one.held, two.held]).toEqual([false, false]);
  expect(log.toSorted()).toEqual(['one loses', 'two gains']);
});

it('a tab that has nothing to write gives way at once', async () => {
  const { all, log } = tabs(['demo', 'work'], new Set(['work']));
  await all[0]!.takeIfFree();
  all[1]!.wait();
  await settle();
  expect(all.map(({ held }) => held)).toEqual([false, true]);
  expect(log).toEqual(['work gains']);
});

it.each<[string, TabLockApis['locks']]>([
  ['without Web Locks', undefined],
  // As Chromium does where the visitor blocks all cookies.
  [
    'where they are forbidden',
    { request: () => Promise.reject(new DOMException('Denied.', 'SecurityError')) },
  ],
])('%s every tab has it', async (_, locks) => {
  const gains: string[] = [];
  const right = new TabLock(
    { name: 'tabs', locks, channel: undefined },
    { gained: () => gains.push('gained'), lost: () => undefined, needed: () => true },
  );
  await right.takeIfFree();
  expect(right.held).toBe(true);
  right.giveBack();
  right.wait();
  await settle();
  expect(right.held).toBe(true);
  expect(gains).toEqual(['gained']);
});
