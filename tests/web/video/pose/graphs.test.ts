import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { loadPoseGraphs } from '../../../../web/video/pose/graphs';

const LIST = 'https://dance.example/models/pose/pose.json';
const listed = (path: string) => ({ path, bytes: 5_000_000, sha256: '0'.repeat(64) });
const list = { detector: listed('detector.onnx'), landmarks: listed('landmarks.onnx') };

/** Some bytes of a file, after these seconds, on a connection that stays open. */
const beginning = (...waits: readonly number[]): Response =>
  new Response(
    new ReadableStream<Uint8Array>({
      start: (body) => {
        for (const wait of waits) setTimeout(() => body.enqueue(new Uint8Array(1000)), 1000 * wait);
      },
    }),
  );

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it.each([
  ['pose.json', () => beginning(0)],
  ['detector.onnx', () => new Response(JSON.stringify(list))],
])('gives the networks up when %s stops coming', async (file, answerList) => {
  // The runtime goes on coming.
  const answer = (url: string): Response =>
    url === LIST ? answerList() : url.endsWith('.wasm') ? beginning(0, 20) : beginning(0);
  vi.stubGlobal('fetch', (url: string) => Promise.resolve(answer(url)));
  const scope = {
    location: new URL('https://dance.example/'),
    navigator: {},
  } as unknown as typeof globalThis;
  const loading = loadPoseGraphs(LIST, scope, () => undefined);
  const given = expect(loading).rejects.toMatchObject({
    code: 'download-failed',
    message: expect.stringContaining(`${file} has arrived for 30 seconds`) as string,
  });
  await vi.advanceTimersByTimeAsync(35_000);
  await given;
});
