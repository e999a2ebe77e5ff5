import { beforeEach, describe, expect, it, vi } from 'vitest';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import type { FileReaders } from '../../../../web/ui/store/services';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { songData, leaderFile, still } from '../../support/made-state';
import { AppError } from '../../../../web/common/error';

const file = (name: string, content: string): File => new File([content], name);
const BVH = 'HIERARCHY\nROOT Hips\n';
const SONG = 'ID3 and so on';

describe('reading files', () => {
  let store: change.Store;
  let files: FileLoader;
  let readers: { -readonly [K in keyof FileReaders]: FileReaders[K] };

  beforeEach(() => {
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    readers = {
      loadSong: (_file, _recipe, { onProgress }) => {
        onProgress({ fraction: 0.5 });
        return Promise.resolve(songData(2));
      },
      readLeader: ({ fps }) => {
        const frames = fps === null ? 60 : 120;
        return Promise.resolve({ file: leaderFile(frames), motion: still(frames) });
      },
      manifest: () => Promise.resolve(small),
    };
    files = new FileLoader(store, {
      loadSong: (...all) => readers.loadSong(...all),
      readLeader: (...all) => readers.readLeader(...all),
      manifest: () => readers.manifest(),
    });
  });

  it('tells songs and leaders apart by content and reads them together', async () => {
    await files.open([file('a', SONG), file('b', BVH)]);
    const { song, leader, reading, firstVisit, problem } = store.getState();
    expect([song?.name, leader?.name]).toEqual(['a', 'b']);
    expect(reading).toEqual({ song: null, leader: null });
    expect(firstVisit).toBe(false);
    expect(problem).toBeNull();
  });

  it('shows a problem with the file’s name when it cannot be read, and changes nothing else', async () => {
    await files.open([file('good.bvh', BVH)]);
    const before = store.getState().leader;
    readers.readLeader = () =>
      Promise.reject(new AppError('missing-joints', 'The legs are missing.', 'Export the whole body.'));
    await files.open([file('arms.bvh', BVH)]);
    expect(store.getState().problem).toEqual({
      code: 'missing-joints',
      title: 'arms.bvh: The legs are missing.',
      hint: 'Export the whole body.',
      remedy: 'leader',
      refused: { kind: 'leader', name: 'arms.bvh' },
    });
    expect(store.getState().leader).toBe(before);
    expect(store.getState().reading.leader).toBeNull();
  });

  it('reads a file again where the page and not the file failed', async () => {
    const { readLeader } = readers;
    readers.readLeader = () =>
      Promise.reject(new AppError('worker-crashed', 'The reading stopped.', 'Try again.'));
    await files.open([file('good.bvh', BVH)]);
    expect(store.getState().problem).toMatchObject({ title: 'The reading stopped.', remedy: 'read-again' });
    readers.readLeader = readLeader;
    files.readAgain('leader');
    await vi.waitFor(() => expect(store.getState().leader?.name).toBe('good.bvh'));
  });

  it.each([
    ['empty.bvh', '', 'empty-file'],
    ['tax.pdf', '%PDF', 'unknown-file'],
    ['dance.glb', 'glTF', 'other-motion'],
  ])('refuses %s without reading it', async (name, content, code) => {
    await files.open([file(name, content)]);
    expect(store.getState().problem?.code).toBe(code);
    expect(store.getState().firstVisit).toBe(true);
  });

  it('the newest file of a kind wins, even if an older one is ready later', async () => {
    const answers: (() => void)[] = [];
    readers.readLeader = ({ text }) =>
      new Promise((resolve) => {
        const frames = text.length;
        answers.push(() => {
          resolve({ file: leaderFile(frames), motion: still(frames) });
        });
      });
    const first = files.openLeader('1234', 'first.bvh', null);
    const second = files.openLeader('12', 'second.bvh', null);
    answers[1]?.();
    await second;
    answers[0]?.();
    expect(await first).toBeNull();
    expect(store.getState().leader?.name).toBe('second.bvh');
  });

  it('an older file that fails after a newer one came shows no problem', async () => {
    let fail: (error: Error) => void = () => undefined;
    readers.readLeader = () => new Promise((_, reject) => (fail = reject));
    const first = files.openLeader(BVH, 'first.bvh', null);
    readers.readLeader = () => Promise.resolve({ file: leaderFile(3), motion: still(3) });
    await files.openLeader(BVH, 'second.bvh', null);
    fail(new Error('too late'));
    await first;
    expect(store.getState()).toMatchObject({ problem: null, leader: { name: 'second.bvh' } });
  });

  it('progress that comes after the result is ignored', async () => {
    let late: (progress: { fraction: number }) => void = () => undefined;
    readers.loadSong = (_file, _recipe, { onProgress }) => {
      late = onProgress;
      return Promise.resolve(songData(2));
    };
    await files.openSong(file('a', SONG), 'a.mp3', null);
    late({ fraction: 1 });
    expect(store.getState().reading.song).toBeNull();
  });

  it('a song waits for the audio recipe of the model', async () => {
    let arrive: (manifest: typeof small) => void = () => undefined;
    readers.manifest = () => new Promise((resolve) => (arrive = resolve));
    const opening = files.openSong(file('a', SONG), 'a.mp3', 'demo song');
    expect(store.getState().reading.song).toEqual({ name: 'a.mp3', fraction: 0 });
    arrive(small);
    await opening;
    expect(store.getState().song).toMatchObject({ name: 'a.mp3', label: 'demo song' });
  });

  it('a leader that was refused is read again at the frame rate that is given by hand', async () => {
    expect(await files.rereadRefused(60)).toBeNull();
    const { readLeader } = readers;
    readers.readLeader = (request, signal) =>
      request.fps === null
        ? Promise.reject(new AppError('bad-frame-time', 'It has no frame rate.', 'Set it by hand.'))
        : readLeader(request, signal);
    await files.open([file('a.bvh', BVH)]);
    expect(store.getState().problem?.code).toBe('bad-frame-time');
    await files.rereadRefused(60);
    expect(store.getState().leader).toMatchObject({ name: 'a.bvh', label: null, fps: 60 });
  });

  it('a leader is read again at another frame rate from its stored text', async () => {
    expect(await files.rereadLeader(60)).toBeNull();
    await files.openLeader(BVH, 'a.bvh', 'demo leader');
    await files.rereadLeader(60);
    expect(store.getState().leader).toMatchObject({
      name: 'a.bvh',
      label: 'demo leader',
      fps: 60,
      text: BVH,
    });
    expect(store.getState().leader?.file.clip.frames).toBe(120);
  });
});
