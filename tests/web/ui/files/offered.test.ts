import { afterEach, expect, it, vi } from 'vitest';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import { OfferedLeaders } from '../../../../web/ui/files/offered';
import type { FileReaders } from '../../../../web/ui/store/services';
import * as change from '../../support/actions';
import { leaderFile, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

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
  const cancel = (): void => {
    offered.cancel();
  };
  const offered: OfferedLeaders = new OfferedLeaders(
    store,
    { open, cancel },
    new URL('https://page.example/leaders/'),
  );
  const slow = offered.open('slow.bvh');
  expect(store.getState().reading.leader?.name).toBe('Slow');
  const quick = offered.open('quick.bvh');
  answers.get('/leaders/quick.bvh')!();
  await quick;
  answers.get('/leaders/slow.bvh')!();
  await slow;
  expect(store.getState().reading.leader).toBeNull();
  expect(opened).toEqual(['Quick.bvh']);

  const playful = offered.open('playful.bvh');
  offered.cancel();
  expect(store.getState().reading.leader).toBeNull();
  answers.get('/leaders/playful.bvh')!();
  await playful;
  expect(opened).toEqual(['Quick.bvh']);
  expect(store.getState().problem).toBeNull();
});

it('a download of which nothing arrives for half a minute is given up, and its name no longer says that it is read', async () => {
  vi.useFakeTimers();
  vi.stubGlobal('fetch', (_: URL, { signal }: { readonly signal: AbortSignal }) => {
    return new Promise((_, reject) => {
      signal.addEventListener('abort', () => {
        reject(signal.reason as Error);
      });
    });
  });
  const store = change.createAppStore('dark');
  const open = vi.fn(() => Promise.resolve());
  const offered = new OfferedLeaders(
    store,
    { open, cancel: () => undefined },
    new URL('https://page.example/leaders/'),
  );
  const opening = offered.open('slow.bvh');
  await vi.advanceTimersByTimeAsync(31_000);
  vi.useRealTimers();
  await opening;
  expect(open).not.toHaveBeenCalled();
  expect(store.getState()).toMatchObject({
    problem: { code: 'page-part-missing' },
    reading: { leader: null },
  });
});

it('takes the place of a file that is still being read', async () => {
  vi.stubGlobal('fetch', () => new Promise(() => undefined));
  const store = change.createAppStore('dark');
  let read = (): void => undefined;
  const readers: FileReaders = {
    loadSong: () => Promise.reject(new Error('no song')),
    readLeader: () =>
      new Promise((resolve) => {
        read = () => {
          resolve({ file: leaderFile(30), motion: still(30) });
        };
      }),
    manifest: () => Promise.resolve(small),
  };
  const files: FileLoader = new FileLoader(store, readers, {
    openVideo: () => Promise.resolve(),
    cancel: () => {
      offered.cancel();
    },
  });
  const offered: OfferedLeaders = new OfferedLeaders(store, files, new URL('https://page.example/leaders/'));
  const before = files.open([new File(['HIERARCHY\nROOT Hips'], 'before.bvh')]);
  await vi.waitFor(() => {
    expect(store.getState().reading.leader?.name).toBe('before.bvh');
  });
  await new Promise((resolve) => setTimeout(resolve, 20));
  void offered.open('slow.bvh');
  read();
  await before;
  expect(store.getState()).toMatchObject({ leader: null, reading: { leader: { name: 'Slow' } } });
});
