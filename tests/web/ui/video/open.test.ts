import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { createVideoFeature, type VideoFeature } from '../../../../web/ui/video/open';
import { VideoTrack } from '../../../../web/ui/video/video-lane';
import * as change from '../../support/actions';

const PART = '../../../../web/ui/video/video-leader';

let opened: string[];
let failed: { readonly error: unknown; readonly again: () => void }[];

function feature(): VideoFeature {
  const files = {
    openLeader: () => Promise.resolve(null),
    openSong: () => Promise.resolve(null),
    fail: (error: unknown, _side: string, _name: string, again: () => void) => failed.push({ error, again }),
  };
  const playback = { seek: () => undefined, togglePlay: () => undefined };
  const host = (): HTMLElement => undefined as never;
  return createVideoFeature(change.createAppStore('dark'), () => files, host, playback, new VideoTrack());
}

/** Stands for what reads videos. */
class Reader {
  open({ name }: File): Promise<void> {
    opened.push(name);
    return Promise.resolve();
  }
  cancel(): void {
    return;
  }
}

beforeEach(() => {
  vi.resetModules();
  [opened, failed] = [[], []];
});

afterEach(() => {
  vi.doUnmock(PART);
});

it('a video is not read if another leader was asked for while what reads it was loaded', async () => {
  let arrive = (): void => undefined;
  const coming = new Promise<void>((resolve) => (arrive = resolve));
  vi.doMock(PART, async () => {
    await coming;
    return { VideoLeader: Reader };
  });
  const video = feature();
  const opening = video.open(new File([], 'older.mov'));
  video.cancel();
  arrive();
  await opening;
  expect(opened).toEqual([]);
  await video.open(new File([], 'newer.mov'));
  expect(opened).toEqual(['newer.mov']);
});

it('a part of the page that is missing is not the fault of the file, which is read once the part is there', async () => {
  vi.doMock(PART, () => {
    throw new Error('404');
  });
  const video = feature();
  await video.open(new File([], 'a.mov'));
  expect(failed).toMatchObject([{ error: { code: 'page-part-missing' } }]);
  vi.doMock(PART, () => ({ VideoLeader: Reader }));
  failed[0]!.again();
  await vi.waitFor(() => expect(opened).toEqual(['a.mov']));
});

it('a double click opens the camera once, and it can be opened again when its dialog is closed', async () => {
  let dialogs = 0;
  let close = (): void => undefined;
  vi.doMock('../../../../web/ui/video/camera-dialog', () => ({
    recordCamera: () => {
      dialogs++;
      return new Promise<null>((resolve) => (close = () => resolve(null)));
    },
  }));
  const video = feature();
  const first = video.record();
  await vi.waitFor(() => expect(dialogs).toBe(1));
  // It ends at once, without a dialog of its own.
  await video.record();
  expect(dialogs).toBe(1);
  close();
  await first;
  void video.record();
  await vi.waitFor(() => expect(dialogs).toBe(2));
  close();
  vi.doUnmock('../../../../web/ui/video/camera-dialog');
});
