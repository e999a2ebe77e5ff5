import {
  BufferTarget,
  EncodedPacket,
  EncodedVideoPacketSource,
  Input,
  Mp4OutputFormat,
  Output,
  type OutputFormat,
  type VideoCodec,
  WebMOutputFormat,
} from 'mediabunny';
import { afterEach, expect, test, vi } from 'vitest';
import { openPictures } from '../../../web/video/client';
import { unlessStalled, openVideo, pictureChoice } from '../../../web/video/frames';

/** Ten pictures, 10 a second, that hold nothing; those who open the file see no difference. */
async function emptyVideo(
  codec: VideoCodec,
  codecString: string,
  description?: Uint8Array,
  format: OutputFormat = new Mp4OutputFormat(),
): Promise<Blob> {
  const target = new BufferTarget();
  const output = new Output({ format, target });
  const source = new EncodedVideoPacketSource(codec);
  output.addVideoTrack(source);
  await output.start();
  const decoderConfig = {
    codec: codecString,
    codedWidth: 640,
    codedHeight: 480,
    ...(description && { description }),
  };
  for (let i = 0; i < 10; i++) {
    const packet = new EncodedPacket(new Uint8Array(100), i === 0 ? 'key' : 'delta', i / 10, 0.1);
    await source.add(packet, { decoderConfig });
  }
  await output.finalize();
  return new Blob([target.buffer!]);
}

const avc = (): Promise<Blob> =>
  emptyVideo('avc', 'avc1.42001e', Uint8Array.of(1, 0x42, 0, 0x1e, 0xff, 0xe0, 0));

/** What the decoder of the browser says of every codec. */
function decodes(supported: boolean): void {
  vi.stubGlobal('VideoDecoder', { isConfigSupported: () => Promise.resolve({ supported }) });
}

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
  vi.restoreAllMocks();
});

/** Pictures that are read of ten seconds, whose times vary by up to 3 ms to either side. */
function read(fps: number): number {
  const times = Array.from({ length: 10 * fps }, (_, i) => i / fps + 0.003 * Math.sin(2.7 * i));
  return times.filter(pictureChoice()).length;
}

test.each([10, 24, 25, 30])('every picture of a video of %i a second is read', (fps) => {
  expect(read(fps)).toBe(10 * fps);
});

test.each([40, 48, 50, 60, 90, 120, 240])('of %i pictures a second at most 30 are read', (fps) => {
  expect(read(fps)).toBeLessThanOrEqual(301);
  expect(read(fps)).toBeGreaterThan(200);
});

test('of HEVC, in which phones record, it is said how to film otherwise', async () => {
  decodes(false);
  // Version 1, profile Main, level 3.1, no parameter sets.
  const description = new Uint8Array(23);
  description.set([
    1, 1, 0x60, 0, 0, 0, 0x90, 0, 0, 0, 0, 0, 93, 0xf0, 0, 0xfc, 0xfd, 0xf8, 0xf8, 0, 0, 3, 0,
  ]);
  await expect(openVideo(await emptyVideo('hevc', 'hvc1.1.6.L93.90', description))).rejects.toMatchObject({
    code: 'video-codec',
    message: expect.stringContaining('HEVC') as unknown,
    hint: expect.stringContaining('Most Compatible') as unknown,
  });
});

test('of H.264 that is not decoded it is said which kind is, and not to save it as H.264', async () => {
  decodes(false);
  await expect(openVideo(await avc())).rejects.toMatchObject({
    code: 'video-codec',
    hint: expect.stringContaining('8 bits and 4:2:0') as unknown,
  });
});

test('a decoder that gives nothing more is not waited for forever, and one that is given time is', async () => {
  vi.useFakeTimers();
  let ended = false;
  const decoder: AsyncIterator<number> = {
    next: vi
      .fn()
      .mockResolvedValueOnce({ done: false, value: 1 })
      .mockImplementation(() => new Promise(() => undefined)),
    return: () => {
      ended = true;
      return Promise.resolve({ done: true, value: undefined });
    },
  };
  const pictures = unlessStalled(decoder);
  expect(await pictures.next()).toEqual({ done: false, value: 1 });
  // A network that takes long is not the decoder's delay.
  await vi.advanceTimersByTimeAsync(60_000);
  const next = expect(pictures.next()).rejects.toMatchObject({ code: 'video-stalled' });
  await vi.advanceTimersByTimeAsync(29_000);
  expect(ended).toBe(false);
  await vi.advanceTimersByTimeAsync(2_000);
  await next;
  expect(ended).toBe(true);
});

test('a codec that is not known is named as the file names it', async () => {
  decodes(false);
  const bytes = new Uint8Array(await (await avc()).arrayBuffer());
  const at = Buffer.from(bytes.buffer).lastIndexOf('avc1');
  bytes.set(Buffer.from('mp4v'), at);
  await expect(openVideo(new Blob([bytes]))).rejects.toMatchObject({
    code: 'video-codec',
    message: expect.stringContaining('(mp4v)') as unknown,
  });
});

test('a browser that decodes no video for pages is not taken for one that lacks a codec', async () => {
  vi.stubGlobal('isSecureContext', true);
  await expect(openVideo(await avc())).rejects.toMatchObject({ code: 'video-unread' });
  vi.stubGlobal('isSecureContext', false);
  await expect(openVideo(await avc())).rejects.toMatchObject({ code: 'video-insecure' });
});

test('of a file whose end is missing the time of the last picture is known', async () => {
  decodes(true);
  const whole = await avc();
  for (const file of [whole, whole.slice(0, whole.size - 500)]) {
    const video = await openVideo(file);
    expect(video.last).toBeCloseTo(0.9, 3);
    expect(video.end).toBeCloseTo(1, 3);
    video.close();
  }
});

test('a WebM file of which only the beginning is there is not said to lack a person', async () => {
  decodes(true);
  const whole = await emptyVideo('vp8', 'vp8', undefined, new WebMOutputFormat());
  await expect(openVideo(whole.slice(0, whole.size / 2))).rejects.toMatchObject({
    code: 'not-a-video',
    hint: expect.stringContaining('its end may be missing') as unknown,
  });
});

test('a video whose first picture cannot be decoded is closed', async () => {
  const closed = vi.spyOn(Input.prototype, 'dispose');
  // A decoder that cannot be made.
  decodes(true);
  await expect(openPictures(await avc(), 0)).rejects.toMatchObject({ code: 'video-damaged' });
  expect(closed).toHaveBeenCalledOnce();
});
