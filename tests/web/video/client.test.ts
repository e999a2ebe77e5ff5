import { serve } from '../../../web/common/serve-tasks';
import { afterEach, expect, it, vi } from 'vitest';
import { createVideoReader, type Observations, type WorldOptions } from '../../../web/video/client';

/** The workers that were made, in order. */
const workers: VideoWorker[] = [];

/** A worker on this thread whose motions are its number. */
class VideoWorker extends EventTarget {
  readonly #channel = new MessageChannel();

  constructor() {
    super();
    const number = workers.push(this);
    serve({ solve: () => number }, this.#channel.port2);
    this.#channel.port1.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
      this.dispatchEvent(new MessageEvent('message', { data }));
    });
    this.#channel.port1.start();
  }

  postMessage(message: unknown, transfers: MessagePort[]): void {
    this.#channel.port1.postMessage(message, transfers);
  }

  terminate(): void {
    this.#channel.port1.close();
  }
}

afterEach(() => {
  vi.unstubAllGlobals();
});

it('after a crash of its worker a video is corrected by a new one, until it is closed', async () => {
  vi.stubGlobal('Worker', VideoWorker);
  vi.stubGlobal('document', { baseURI: 'https://page.example/' });
  const reader = createVideoReader();
  const seen = {} as Observations;
  const options = {} as WorldOptions;
  const solve = (): Promise<unknown> => reader.solve(seen, options, new AbortController().signal);
  expect(await solve()).toBe(1);
  workers[0]!.dispatchEvent(
    Object.assign(new Event('error', { cancelable: true }), { message: 'out of memory' }),
  );
  expect(await solve()).toBe(2);
  reader.dispose();
  await expect(solve()).rejects.toThrow('ended');
  expect(workers).toHaveLength(2);
});
