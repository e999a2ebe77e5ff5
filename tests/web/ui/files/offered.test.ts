import { afterEach, expect, it, vi } from 'vitest';
import { OfferedLeaders } from '../../../../web/ui/files/offered';
import * as change from '../../support/actions';

afterEach(() => {
  vi.unstubAllGlobals();
});

it('the leader that was clicked last is opened, also where an older download ends later, and none once cancelled', async () => {
  const answers = new Map<string, () => void>();
  vi.stubGlobal('fetch', (address: URL, { signal }: { readonly signal: AbortSignal }) => {
    return new Promise((resolve, reject) => {
      signal.addEventListener('abort', () => {
        reject(signal.reason as Error);
      });
      answers.set(address.pathname, () => {
        resolve(new Response('HIERARCHY'));
      });
    });
  });
  const store = change.createAppStore('dark');
  const opened: string[] = [];
  const open = (files: readonly File[]): Promise<void> => {
    opened.push(...files.map(({ name }) => name));
    return Promise.resolve();
  };
  const offered = new OfferedLeaders(store, { open }, new URL('https://page.example/leaders/'));
  const slow = offered.open('slow.bvh');
  const quick = offered.open('quick.bvh');
  answers.get('/leaders/quick.bvh')!();
  await quick;
  answers.get('/leaders/slow.bvh')!();
  await slow;
  expect(opened).toEqual(['Quick.bvh']);

  const playful = offered.open('playful.bvh');
  offered.cancel();
  answers.get('/leaders/playful.bvh')!();
  await playful;
  expect(opened).toEqual(['Quick.bvh']);
  expect(store.getState().problem).toBeNull();
});
