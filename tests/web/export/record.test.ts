import { afterEach, expect, test, vi } from 'vitest';
import { recordVideo } from '../../../web/export/video/record';
import type { VideoSource } from '../../../web/export/video/source';

/** Frames of a dance of ten seconds. */
const FRAMES = 300;

/** A recorder that takes nothing, and fails or ends when it is told to. */
class Recorder {
  static made: Recorder[] = [];
  state = 'inactive';
  onstop: (() => void) | null = null;
  onerror: (() => void) | null = null;

  constructor() {
    Recorder.made.push(this);
  }

  start(): void {
    this.state = 'recording';
  }

  stop(): void {
    this.end('onstop');
  }

  end(how: 'onstop' | 'onerror'): void {
    this.state = 'inactive';
    this[how]?.();
  }
}

/** A canvas whose stream has one track, which tells whether it was stopped. */
function source(onDraw: (frame: number) => void): { source: VideoSource; stopped: () => boolean } {
  let stopped = false;
  const track = { stop: () => (stopped = true) };
  const canvas = { captureStream: () => ({ getTracks: () => [track], addTrack: () => undefined }) };
  return {
    source: {
      fps: 30,
      frames: FRAMES,
      draw: onDraw,
      canvas: canvas as unknown as HTMLCanvasElement,
      sound: null,
    },
    stopped: () => stopped,
  };
}

const plan = { way: 'record', container: 'webm', type: 'video/webm' } as const;
const options = { signal: new AbortController().signal, onProgress: () => undefined };

afterEach(() => {
  vi.unstubAllGlobals();
  Recorder.made.length = 0;
});

test.each(['onstop', 'onerror'] as const)(
  'a recorder that ends by itself (%s) is not drawn for any longer',
  async (how) => {
    vi.stubGlobal('MediaRecorder', Recorder);
    let drawn = 0;
    const { source: dance, stopped } = source((frame) => {
      drawn++;
      if (frame >= 2 && Recorder.made[0]!.state === 'recording') Recorder.made[0]!.end(how);
    });
    await expect(recordVideo(dance, plan, options)).rejects.toThrow('The recorder stopped.');
    expect(drawn).toBeLessThan(10);
    expect(stopped()).toBe(true);
  },
);

test('where no recorder can be made, the stream and the sound are ended', async () => {
  vi.stubGlobal(
    'MediaRecorder',
    class {
      constructor() {
        throw new DOMException('no such codec', 'NotSupportedError');
      }
    },
  );
  let closed = false;
  const node = { connect: () => undefined, stream: { getAudioTracks: () => [] } };
  vi.stubGlobal(
    'AudioContext',
    class {
      readonly createBuffer = () => ({ copyToChannel: () => undefined });
      readonly createMediaStreamDestination = () => node;
      readonly createBufferSource = () => node;
      readonly close = () => Promise.resolve((closed = true));
    },
  );
  vi.stubGlobal(
    'OfflineAudioContext',
    class {
      readonly decodeAudioData = () =>
        Promise.resolve({ sampleRate: 8000, numberOfChannels: 1, getChannelData: () => new Float32Array(8) });
    },
  );
  const { source: dance, stopped } = source(() => undefined);
  const sound = { file: new Blob(), start: 0 };
  await expect(recordVideo({ ...dance, sound }, plan, options)).rejects.toThrow('no such codec');
  expect([stopped(), closed]).toEqual([true, true]);
});
