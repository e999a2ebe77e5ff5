import { beforeEach, describe, expect, it, vi } from 'vitest';
import { undoLast } from '../../../../web/ui/store/history/asked';
import { redone, undone } from '../../../../web/ui/store/history/history';
import { takeChosen } from '../../../../web/ui/store/actions/takes';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import type { FileReaders } from '../../../../web/ui/store/services';
import type { LeaderSource } from '../../../../web/ui/store/reaction';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { songData, leaderFile, still } from '../../support/made-state';
import { AppError } from '../../../../web/common/error';

const file = (name: string, content: string): File => new File([content], name);
const BVH = 'HIERARCHY\nROOT Hips\n';
const source = (name: string, content = BVH, label: string | null = null): LeaderSource => ({
  name,
  label,
  files: [{ name, bytes: new TextEncoder().encode(content) }],
  options: {},
});
const SONG = 'ID3 and so on';

describe('reading files', () => {
  let store: change.Store;
  let files: FileLoader;
  let videos: string[];
  let cancelOther: ReturnType<typeof vi.fn<() => void>>;
  let readers: { -readonly [K in keyof FileReaders]: FileReaders[K] };

  beforeEach(() => {
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    readers = {
      loadSong: (_file, _recipe, { onProgress }) => {
        onProgress(0.5);
        return Promise.resolve(songData(2));
      },
      readLeader: ({ options }) => {
        const frames = options.fps === undefined ? 60 : 120;
        return Promise.resolve({ file: leaderFile(frames), motion: still(frames) });
      },
      manifest: () => Promise.resolve(small),
    };
    videos = [];
    cancelOther = vi.fn();
    files = new FileLoader(
      store,
      {
        loadSong: (...all) => readers.loadSong(...all),
        readLeader: (...all) => readers.readLeader(...all),
        manifest: () => readers.manifest(),
      },
      {
        openVideo: ({ name }) => {
          videos.push(name);
          return Promise.resolve();
        },
        cancel: cancelOther,
      },
    );
  });

  it('hands videos on', async () => {
    await files.open([file('dance.mov', '\u0000\u0000\u0000\u0014ftypqt  '), file('b', SONG)]);
    expect(videos).toEqual(['dance.mov']);
    expect(store.getState().song?.name).toBe('b');
  });

  it('takes the sound of a video that is chosen as the song', async () => {
    await files.open([file('party.mp4', '\u0000\u0000\u0000\u0014ftypisom')], 'song');
    expect(videos).toEqual([]);
    expect(store.getState().song?.name).toBe('party.mp4');
  });

  it('a newer leader of the visitor’s ends what is still made of a video or downloaded; the page’s own and songs do not', async () => {
    const demo = await files.openLeader(source('demo.bvh', BVH, 'demo leader'));
    await files.readLeader(source('stored.bvh'));
    await files.open([file('a.mp3', SONG)]);
    expect(cancelOther).not.toHaveBeenCalled();
    await files.open([file('mine.bvh', BVH)]);
    expect(cancelOther).toHaveBeenCalledTimes(1);
    await files.rereadLeader(demo!, { fps: 60 });
    expect(cancelOther).toHaveBeenCalledTimes(2);
    await files.open([file('dance.mov', '\u0000\u0000\u0000\u0014ftypqt  ')]);
    expect(cancelOther).toHaveBeenCalledTimes(3);
  });

  it('tells songs and leaders apart by content and reads them together', async () => {
    await files.open([file('a', SONG), file('b', BVH)]);
    const { song, leader, reading, firstVisit, problem } = store.getState();
    expect([song?.name, leader?.name]).toEqual(['a', 'b']);
    expect(reading).toEqual({ song: null, leader: null });
    expect(firstVisit).toBe(false);
    expect(problem).toBeNull();
  });

  it('the same song chosen again stays as it is, and ends the reading of another one; one with other bytes is read', async () => {
    await files.open([file('a.mp3', SONG)]);
    const { song, history } = store.getState();
    const { loadSong } = readers;
    readers.loadSong = (_file, _recipe, { signal }) =>
      new Promise((_, reject) => signal.addEventListener('abort', () => reject(new Error('ended'))));
    const other = files.open([file('b.mp3', SONG)]);
    await vi.waitFor(() => expect(store.getState().reading.song?.name).toBe('b.mp3'));
    await files.open([file('a.mp3', SONG)]);
    await other;
    expect(store.getState()).toMatchObject({ reading: { song: null }, problem: null });
    expect(store.getState().song).toBe(song);
    expect(store.getState().history).toBe(history);
    expect(store.getState().toast?.text).toBe('a.mp3 is already on the page.');

    readers.loadSong = loadSong;
    await files.open([file('a.mp3', SONG.replace('so', 'no'))]);
    expect(store.getState().song).not.toBe(song);
  });

  it('undoes a song and a leader that were dropped together in one step', async () => {
    await files.open([file('first.bvh', BVH), file('first', SONG)]);
    await files.open([file('b', SONG), file('b.bvh', BVH)]);
    const names = () => [store.getState().song?.name, store.getState().leader?.name];
    change.apply(store, undone());
    expect(names()).toEqual(['first', 'first.bvh']);
    change.apply(store, redone());
    expect(names()).toEqual(['b', 'b.bvh']);
  });

  it('leaves one of two files that could be read, and what was done meanwhile, steps of their own', async () => {
    await files.open([file('first.bvh', BVH)]);
    readers.readLeader = () => Promise.reject(new AppError('bad-frame-time', 'No rate.', 'Choose one.'));
    await files.open([file('a', SONG)]);
    change.apply(store, change.seedSet(5));
    await files.open([file('b', SONG), file('b.bvh', BVH)]);
    expect(store.getState().history.past).toHaveLength(3);
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

  it('a refused leader can be read in another way, until the loaded one is kept', async () => {
    const { readLeader } = readers;
    await files.open([file('good.bvh', BVH)]);
    readers.readLeader = () => Promise.reject(new AppError('bad-frame-time', 'No rate.', 'Choose one.'));
    await files.open([file('broken.bvh', BVH)]);
    const { leader, refusedLeader } = store.getState();
    expect(refusedLeader?.name).toBe('broken.bvh');
    change.apply(store, change.problemClosed());
    expect(store.getState().refusedLeader, 'its remedies close the dialog').toBe(refusedLeader);
    readers.readLeader = readLeader;
    await files.rereadLeader(leader!, { fps: 60 });
    expect(store.getState()).toMatchObject({ leader: { name: 'good.bvh' }, problem: null });
    readers.readLeader = () => Promise.reject(new AppError('bad-frame-time', 'No rate.', 'Choose one.'));
    await files.open([file('broken.bvh', BVH)]);
    change.apply(store, change.problemDismissed());
    expect(store.getState()).toMatchObject({ leader: { name: 'good.bvh' }, refusedLeader: null });
  });

  it('a refused leader stays to be read in another way where there is no other one', async () => {
    readers.readLeader = () => Promise.reject(new AppError('bad-frame-time', 'No rate.', 'Choose one.'));
    await files.open([file('broken.bvh', BVH)]);
    change.apply(store, change.problemDismissed());
    expect(store.getState().refusedLeader?.name).toBe('broken.bvh');
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

  it('what failed last is read again, also where another part of the page reads it', async () => {
    readers.readLeader = () => Promise.reject(new AppError('bad-number', 'Line 3.', 'Export it again.'));
    await files.open([file('older.bvh', BVH)]);
    change.apply(store, change.problemClosed());
    const again = vi.fn();
    // Not the video but what reads it could not be had.
    for (const code of ['worker-crashed', 'download-failed'] as const) {
      files.fail(new AppError(code, 'The video stopped.', 'Try again.'), 'leader', 'a.mov', again);
      expect(store.getState().problem).toMatchObject({ remedy: 'read-again', refused: { name: 'a.mov' } });
      change.apply(store, change.problemClosed());
    }
    files.readAgain('leader');
    expect(again).toHaveBeenCalledOnce();
  });

  it.each([
    ['empty.bvh', '', 'empty-file'],
    ['tax.pdf', '%PDF', 'unknown-file'],
  ])('refuses %s without reading it', async (name, content, code) => {
    await files.open([file(name, content)]);
    expect(store.getState().problem?.code).toBe(code);
    expect(store.getState().firstVisit).toBe(true);
  });

  it('says of an archive that is no zip that it is to be unpacked', async () => {
    await files.open([file('takes.7z', '7z\u00bc\u00af')]);
    expect(store.getState().problem?.hint).toContain('Unpack it');
  });

  it.each([
    ['gBR_sBM_cAll_d04_mBR0_ch01.pkl', 'save its arrays, such as smpl_poses'],
    ['subject.mot', 'choose the TRC of its markers'],
    ['Take 2024.tak', 'Export the take in Motive'],
    ['dance.blend', 'Export its animation as FBX, glTF or BVH'],
  ])('says what to do with %s', async (name, hint) => {
    await files.open([file(name, 'x')]);
    expect(store.getState().problem).toMatchObject({ code: 'unknown-file' });
    expect(store.getState().problem?.hint).toContain(hint);
  });

  it('the newest file of a kind wins, even if an older one is ready later', async () => {
    const answers: (() => void)[] = [];
    readers.readLeader = ({ files: [source] }) =>
      new Promise((resolve) => {
        const frames = source!.bytes.length;
        answers.push(() => {
          resolve({ file: leaderFile(frames), motion: still(frames) });
        });
      });
    const first = files.openLeader(source('first.bvh', '1234'));
    await Promise.resolve();
    const second = files.openLeader(source('second.bvh', '12'));
    await Promise.resolve();
    expect(answers).toHaveLength(2);
    answers[1]?.();
    await second;
    answers[0]?.();
    expect(await first).toBeNull();
    expect(store.getState().leader?.name).toBe('second.bvh');
  });

  /** Readers that answer when they are told to; what is cancelled they answer all the same. */
  function slowReaders(): { readonly answer: () => Promise<void> } {
    const answers: (() => void)[] = [];
    const later = <T>(value: T): Promise<T> =>
      new Promise((resolve) => {
        answers.push(() => {
          resolve(value);
        });
      });
    readers.loadSong = () => later(songData(2));
    readers.readLeader = () => later({ file: leaderFile(9), motion: still(9) });
    return {
      answer: async () => {
        await vi.waitFor(() => expect(answers).not.toEqual([]));
        for (const answer of answers.splice(0)) answer();
        await new Promise((resolve) => setTimeout(resolve));
      },
    };
  }

  it.each([
    ['song', 'late.mp3', SONG],
    ['leader', 'late.bvh', BVH],
  ] as const)(
    'undo ends the reading of a %s, after the steps that are newer',
    async (kind, name, content) => {
      await files.open([file('a.mp3', SONG), file('a.bvh', BVH)]);
      const { seed } = store.getState().settings!;
      change.apply(store, change.seedSet(11));
      const { answer } = slowReaders();
      void files.open([file(name, content)]);
      await vi.waitFor(() => expect(store.getState().reading[kind]?.name).toBe(name));
      change.apply(store, change.heightSet(1.8));

      undoLast(store, files);
      expect(store.getState()).toMatchObject({
        settings: { seed: 11, height: null, holdHands: true },
        reading: { [kind]: { name } },
      });
      undoLast(store, files);
      expect(store.getState()).toMatchObject({
        settings: { seed: 11 },
        reading: { [kind]: null },
        asked: [],
      });
      expect(cancelOther).toHaveBeenCalledTimes(kind === 'leader' ? 3 : 1);
      await answer();
      expect(store.getState()[kind]?.name).not.toBe(name);
      undoLast(store, files);
      expect(store.getState().settings!.seed).toBe(seed);
    },
  );

  it('what the page reads by itself is not ended by undo, which undoes a step', async () => {
    await files.open([file('a.mp3', SONG), file('a.bvh', BVH)]);
    const { seed } = store.getState().settings!;
    const { answer } = slowReaders();
    const stored = files.readSong(file('b', SONG), 'b.mp3', null, Promise.resolve());
    change.apply(store, change.seedSet(11));
    undoLast(store, files);
    expect(store.getState().settings!.seed).toBe(seed);
    await answer();
    expect(await stored).toMatchObject({ name: 'b.mp3' });
  });

  it('a take of another leader, chosen while a leader is read, stays; one of the same leader does not end the reading', async () => {
    const take = (): string => {
      const { leader, song, shift, settings, takes } = store.getState();
      const inputs = { leader: leader!, song, shift, settings: settings! };
      const reaction = {
        motion: still(60),
        latents: null,
        model: undefined,
        inputs,
        label: null,
        seconds: 1,
      };
      const id = `take ${takes.length}`;
      change.apply(store, change.reactionAdded(reaction, { id, at: 0 }));
      return id;
    };
    await files.open([file('a.bvh', BVH)]);
    const ofA = take();
    await files.open([file('b.bvh', BVH)]);
    const ofB = take();
    change.apply(store, change.seedSet(11));
    take();
    const { answer } = slowReaders();
    const reading = files.open([file('late.bvh', BVH)]);
    await vi.waitFor(() => expect(store.getState().reading.leader?.name).toBe('late.bvh'));
    change.apply(store, takeChosen(ofB));
    expect(store.getState()).toMatchObject({
      leader: { name: 'b.bvh' },
      reading: { leader: { name: 'late.bvh' } },
    });
    change.apply(store, takeChosen(ofA));
    expect(store.getState()).toMatchObject({ leader: { name: 'a.bvh' }, reading: { leader: null } });
    await answer();
    await reading;
    expect(store.getState()).toMatchObject({ leader: { name: 'a.bvh' }, asked: [] });
  });

  it('a video ends the reading of an older motion file of the visitor’s, not of what the page reads by itself', async () => {
    let finish = (): void => undefined;
    readers.readLeader = () =>
      new Promise((resolve) => (finish = () => resolve({ file: leaderFile(60), motion: still(60) })));
    const video = file('dance.mov', '\u0000\u0000\u0000\u0014ftypqt  ');
    const older = files.open([file('large.fbx', BVH)]);
    await vi.waitFor(() => expect(store.getState().reading.leader).not.toBeNull());
    await files.open([video]);
    expect(store.getState().reading.leader).toBeNull();
    finish();
    await older;
    expect(store.getState().leader).toBeNull();

    const demo = files.openLeader(source('demo.bvh', BVH, 'demo leader'));
    await files.open([video]);
    finish();
    await demo;
    expect(store.getState().leader?.name).toBe('demo.bvh');
  });

  it('an older file that fails after a newer one came shows no problem', async () => {
    let fail: (error: Error) => void = () => undefined;
    readers.readLeader = () => new Promise((_, reject) => (fail = reject));
    const first = files.openLeader(source('first.bvh'));
    await Promise.resolve();
    readers.readLeader = () => Promise.resolve({ file: leaderFile(3), motion: still(3) });
    await files.openLeader(source('second.bvh'));
    fail(new Error('too late'));
    expect(await first).toBeNull();
    expect(store.getState()).toMatchObject({ problem: null, leader: { name: 'second.bvh' } });
  });

  it('a large file whose bytes come late does not replace a newer one', async () => {
    let arrive = (): void => undefined;
    const large = file('large.bvh', BVH);
    const bytes = large.arrayBuffer();
    large.arrayBuffer = () => new Promise((resolve) => (arrive = () => resolve(bytes)));
    const first = files.open([large]);
    await vi.waitFor(() => expect(store.getState().reading.leader?.name).toBe('large.bvh'));
    await files.open([file('newer.bvh', BVH)]);
    arrive();
    await first;
    expect(store.getState()).toMatchObject({ leader: { name: 'newer.bvh' }, reading: { leader: null } });
  });

  it('progress that comes after the result is ignored', async () => {
    let late: (fraction: number) => void = () => undefined;
    readers.loadSong = (_file, _recipe, { onProgress }) => {
      late = onProgress;
      return Promise.resolve(songData(2));
    };
    await files.openSong(file('a', SONG), 'a.mp3', null);
    late(1);
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

  it('a stored song is named at once and read when it may', async () => {
    readers.loadSong = vi.fn(() => Promise.resolve(songData(2)));
    let go = (): void => undefined;
    const reading = files.readSong(file('a', SONG), 'a.mp3', null, new Promise((resolve) => (go = resolve)));
    await new Promise((resolve) => setTimeout(resolve));
    expect(store.getState().reading.song?.name).toBe('a.mp3');
    expect(readers.loadSong).not.toHaveBeenCalled();
    go();
    expect(await reading).toMatchObject({ name: 'a.mp3' });
  });

  it('a leader is read again at another frame rate from its stored bytes', async () => {
    const loaded = await files.openLeader(source('a.bvh', BVH, 'demo leader'));
    await files.rereadLeader(loaded!, { fps: 60 });
    expect(store.getState().leader).toMatchObject({
      name: 'a.bvh',
      label: 'demo leader',
      options: { fps: 60 },
      files: source('a.bvh').files,
    });
    expect(store.getState().leader?.file.clip.frames).toBe(120);
    change.apply(store, undone());
    expect(store.getState().leader).toBe(loaded);
  });
});
