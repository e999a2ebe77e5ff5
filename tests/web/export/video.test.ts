import { describe, expect, test, vi } from 'vitest';
import { planVideo, secondsLeft } from '../../../web/export/client';
import { fitted, titleOpacity, wrapped } from '../../../web/export/video/caption';
import { videoPixels } from '../../../web/export/video/size';
import { songSamples } from '../../../web/export/video/song';

describe('the song of a video', () => {
  const sound = { rate: 10, channels: [Float32Array.of(1, 2, 3, 4), Float32Array.of(5, 6, 7, 8)] };

  test('is followed by silence when it is shorter than the dance', () => {
    expect([...songSamples(sound, 0, 2, 4)]).toEqual([3, 4, 0, 0, 7, 8, 0, 0]);
    expect([...songSamples(sound, 0, 9, 2)]).toEqual([0, 0, 0, 0]);
  });

  test('begins later or is cut off at its start when it is shifted', () => {
    expect([...songSamples(sound, 0.3, 0, 5)]).toEqual([0, 0, 0, 1, 2, 0, 0, 0, 5, 6]);
    expect([...songSamples(sound, -0.2, 0, 3)]).toEqual([3, 4, 0, 7, 8, 0]);
  });

  test('has the same samples in one piece and in many', () => {
    const whole = songSamples(sound, 0.1, 0, 6).subarray(0, 6);
    const pieces = [0, 2, 4].flatMap((from) => [...songSamples(sound, 0.1, from, 2).subarray(0, 2)]);
    expect(pieces).toEqual([...whole]);
  });
});

test('the remaining time follows the pace so far, once enough has been done', () => {
  expect(secondsLeft(0.1, 5, 100)).toBeNull();
  expect(secondsLeft(2, 0, 100)).toBeNull();
  expect(secondsLeft(2, 25, 100)).toBe(6);
  expect(secondsLeft(8, 100, 100)).toBe(0);
});

test('width and height are even, as encoders need them', () => {
  const stage = { width: 951, height: 449 };
  expect(videoPixels('stage', stage)).toEqual({ width: 952, height: 450 });
  expect(videoPixels('720p', stage)).toEqual({ width: 1280, height: 720 });
  expect(videoPixels('1080p', stage)).toEqual({ width: 1920, height: 1080 });
  expect(videoPixels('1x1', stage)).toEqual({ width: 1080, height: 1080 });
  expect(videoPixels('9x16', stage)).toEqual({ width: 1080, height: 1920 });
});

test('a title is whole at first, fades and is gone; a line that is too wide is cut', () => {
  expect([0, 3.3, 3.7, 4, 60].map((seconds) => Number(titleOpacity(seconds).toFixed(2)))).toEqual([
    1, 1, 0.5, 0, 0,
  ]);
  const widthOf = (text: string): number => text.length;
  expect(fitted('Patio Clave', 11, widthOf)).toBe('Patio Clave');
  expect(fitted('Patio Clave', 7, widthOf)).toBe('Patio…');
});

test('a long title takes more lines, and only what is beyond the last one is cut', () => {
  const widthOf = (text: string): number => text.length;
  expect(wrapped('Patio Clave', 11, 3, widthOf)).toEqual(['Patio Clave']);
  expect(wrapped('Descarga en la noche', 11, 3, widthOf)).toEqual(['Descarga en', 'la noche']);
  expect(wrapped('Descarga en la noche by a couple', 11, 2, widthOf)).toEqual(['Descarga en', 'la noche b…']);
  expect(wrapped('Donaudampfschifffahrt', 11, 3, widthOf)).toEqual(['Donaudampf…']);
});

test('a browser that can neither encode nor record writes no video', async () => {
  expect('VideoEncoder' in globalThis || 'MediaRecorder' in globalThis).toBe(false);
  expect(await planVideo({ width: 1280, height: 720 }, true)).toBeNull();
});

test('a video has the first pair of codecs that the browser has, and no sound without a song', async () => {
  const size = { width: 1280, height: 720 };
  const encoders = (video: RegExp, audio: RegExp): void => {
    const which = (codecs: RegExp) => ({
      isConfigSupported: (config: { codec: string }) =>
        Promise.resolve({ supported: codecs.test(config.codec), config }),
    });
    vi.stubGlobal('VideoEncoder', which(video));
    vi.stubGlobal('AudioEncoder', which(audio));
  };
  try {
    encoders(/^(avc1|vp09)/, /^(mp4a|opus)/);
    expect(await planVideo(size, true)).toEqual({
      way: 'encode',
      container: 'mp4',
      video: 'avc',
      audio: 'aac',
    });
    expect(await planVideo(size, false)).toEqual({
      way: 'encode',
      container: 'mp4',
      video: 'avc',
      audio: null,
    });
    // Of another size, since answers about one are kept.
    encoders(/^vp8/, /^(mp4a|opus)/);
    expect(await planVideo({ width: 640, height: 360 }, true)).toEqual({
      way: 'encode',
      container: 'webm',
      video: 'vp8',
      audio: 'opus',
    });
  } finally {
    vi.unstubAllGlobals();
  }
});
