import { describe, expect, test, vi } from 'vitest';
import { captioned, planVideo, secondsLeft, writeVideo } from '../../../web/export/client';
import { fitted, titleOpacity, wrapped } from '../../../web/export/video/caption';
import { videoPixels } from '../../../web/export/video/size';
import { decodeSound, songSamples } from '../../../web/export/video/song';
import type { VideoSource } from '../../../web/export/video/source';
import { LOOKS } from '../../../web/view/theme';

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

  test('keeps two channels, and more are mixed into one', async () => {
    const decodedOf = async (...channels: number[][]): Promise<number[][]> => {
      const buffer = {
        sampleRate: 48_000,
        numberOfChannels: channels.length,
        getChannelData: (i: number) => Float32Array.from(channels[i]!),
      };
      vi.stubGlobal(
        'OfflineAudioContext',
        class {
          readonly decodeAudioData = () => Promise.resolve(buffer);
        },
      );
      const { rate, channels: decoded } = await decodeSound(new Blob());
      expect(rate).toBe(48_000);
      return decoded.map((samples) => [...samples]);
    };
    try {
      expect(await decodedOf([1, 2], [3, 4])).toEqual([
        [1, 2],
        [3, 4],
      ]);
      expect(await decodedOf([1, 2], [3, 4], [5, 6], [-1, -8])).toEqual([[2, 1]]);
    } finally {
      vi.unstubAllGlobals();
    }
  });
});

test('a failed video says whether the song or the video failed, a cancelled one gives the reason', async () => {
  const written = (sound: VideoSource['sound'], signal = new AbortController().signal): Promise<Blob> =>
    writeVideo(
      // This canvas cannot be recorded.
      {
        fps: 30,
        frames: 1,
        canvas: {} as HTMLCanvasElement,
        draw: () => undefined,
        sound,
      },
      { way: 'record', container: 'webm', type: 'video/webm' },
      { signal, onProgress: () => undefined },
    );
  await expect(written({ file: new Blob(), start: 0 })).rejects.toMatchObject({ code: 'sound-failed' });
  await expect(written(null)).rejects.toMatchObject({ code: 'video-failed' });
  await expect(written(null, AbortSignal.abort('cancelled'))).rejects.toBe('cancelled');
  const controller = new AbortController();
  const neverRead = Object.assign(new Blob(), {
    arrayBuffer: () => {
      controller.abort('cancelled meanwhile');
      return new Promise<never>(() => undefined);
    },
  });
  await expect(written({ file: neverRead, start: 0 }, controller.signal)).rejects.toBe('cancelled meanwhile');
});

describe('words in a video', () => {
  /** Canvases whose letters are all half as wide as high, and what was drawn on them. */
  const drawnBy = (
    captions: { title: string; credit: string },
    seconds: number,
  ): { picture: HTMLCanvasElement; canvas: HTMLCanvasElement; calls: unknown[][] } => {
    const calls: unknown[][] = [];
    const context = {
      font: '',
      fillStyle: '',
      globalAlpha: 1,
      measureText: (text: string) => ({
        width: (text.length * parseInt(context.font.split(' ')[1]!, 10)) / 2,
      }),
      drawImage: (image: unknown) => calls.push(['picture', image, context.globalAlpha]),
      fillText: (text: string, x: number, y: number) =>
        calls.push([text, Math.round(x), Math.round(y), context.globalAlpha, context.fillStyle]),
    };
    vi.stubGlobal('document', { createElement: () => ({ getContext: () => context }) });
    const picture = { width: 2000, height: 1000 } as HTMLCanvasElement;
    try {
      const { canvas, draw } = captioned(picture, captions, 'dark');
      draw(seconds);
      return { picture, canvas, calls };
    } finally {
      vi.unstubAllGlobals();
    }
  };
  const colour = `#${LOOKS.dark.contrast.toString(16).padStart(6, '0')}`;

  test('are a title at the top, which fades, and a credit at the bottom, which stays', () => {
    const { picture, canvas, calls } = drawnBy({ title: 'Patio', credit: 'Clave' }, 3.7);
    expect(canvas).toMatchObject({ width: 2000, height: 1000 });
    expect(calls).toEqual([
      ['picture', picture, 1],
      ['Patio', 45, 100, expect.closeTo(0.5), colour],
      ['Clave', 45, 955, 1, colour],
    ]);
  });

  test('of several lines go down from the top and up from the bottom', () => {
    const { calls } = drawnBy({ title: 'a'.repeat(69) + ' b', credit: 'c'.repeat(146) + ' d' }, 0);
    const [, first, second, third, fourth] = calls;
    expect([first![2], second![2]]).toEqual([100, 169]);
    expect([third![2], fourth![2]]).toEqual([923, 955]);
    expect(fourth![0]).toBe('d');
  });

  test('begin at the right where they are read from there', () => {
    const { calls } = drawnBy({ title: '«سالسا» 2026!', credit: 'Clave' }, 0);
    expect(calls.slice(1).map(([, x]) => x)).toEqual([1955, 45]);
  });

  test('cost nothing where there are none', () => {
    const { picture, canvas, calls } = drawnBy({ title: ' ', credit: '' }, 0);
    expect(canvas).toBe(picture);
    expect(calls).toEqual([]);
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

test('a title of a script without spaces takes more lines too, and no sign begins one', () => {
  const widthOf = (text: string): number => text.length;
  const title = '東京の夜のサルサ、二人の踊り。';
  const lines = wrapped(title, 6, 3, widthOf);
  expect(lines.join('')).toBe(title);
  expect(lines).toHaveLength(3);
  for (const line of lines) {
    expect(line.length).toBeLessThanOrEqual(6);
    expect(line).not.toMatch(/^[、。]/);
  }
  expect(wrapped('Salsa 東京の夜 in Tokyo', 9, 3, widthOf)).toEqual(['Salsa 東京の', '夜 in', 'Tokyo']);
});

test('no emoji is cut in two', () => {
  const widthOf = (text: string): number => text.length;
  expect(fitted('Salsa 💃🏽💃🏽', 9, widthOf)).toBe('Salsa…');
  expect(fitted('Salsa 💃🏽💃🏽', 11, widthOf)).toBe('Salsa 💃🏽…');
});

test('a browser that can neither encode nor record writes no video', async () => {
  expect('VideoEncoder' in globalThis || 'MediaRecorder' in globalThis).toBe(false);
  expect(await planVideo({ width: 1280, height: 720 }, true)).toBeNull();
});

/** A browser that encodes these codecs. */
function encoders(video: RegExp, audio: RegExp): void {
  const which = (codecs: RegExp) => ({
    isConfigSupported: (config: { codec: string }) =>
      Promise.resolve({ supported: codecs.test(config.codec), config }),
  });
  vi.stubGlobal('VideoEncoder', which(video));
  vi.stubGlobal('AudioEncoder', which(audio));
}

test('a video has the first pair of codecs that the browser has, and no sound without a song', async () => {
  const size = { width: 1280, height: 720 };
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

test('without WebCodecs a video is recorded, where the browser can', async () => {
  const size = { width: 320, height: 180 };
  try {
    const isTypeSupported = (type: string): boolean => type.includes('vp8');
    vi.stubGlobal('MediaRecorder', { isTypeSupported });
    vi.stubGlobal('HTMLCanvasElement', class {});
    expect(await planVideo(size, true)).toBeNull();
    vi.stubGlobal('HTMLCanvasElement', { prototype: { captureStream: () => null } });
    expect(await planVideo(size, true)).toEqual({
      way: 'record',
      container: 'webm',
      type: 'video/webm;codecs=vp8,opus',
    });
  } finally {
    vi.unstubAllGlobals();
  }
});
