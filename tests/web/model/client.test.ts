import { serve } from '../../../web/common/serve-tasks';
import { afterEach, expect, it, vi } from 'vitest';
import { createGenerator } from '../../../web/model/client';
import type { Source } from '../../../web/model/sample/inputs';
import { still } from '../support/made-state';
import { small } from '../support/small-manifest';

/** The model's worker on this thread, which notes what it is told to dance to. */
class NotingWorker extends EventTarget {
  static readonly told: (string | null)[] = [];
  readonly #channel = new MessageChannel();

  constructor() {
    super();
    serve(
      {
        load: () => ({ manifest: small, backend: { name: 'wasm', reason: '', threads: 1 } }),
        generate: ({ source }: { source: Source | null }) => {
          NotingWorker.told.push(source && source.role!);
        },
      },
      this.#channel.port2,
    );
    this.#channel.port1.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
      this.dispatchEvent(new MessageEvent('message', { data }));
    });
    this.#channel.port1.start();
  }

  postMessage(message: unknown, transfers: Transferable[] = []): void {
    this.#channel.port1.postMessage(message, transfers);
  }

  terminate(): void {
    this.#channel.port1.close();
  }
}

afterEach(() => vi.unstubAllGlobals());

it('a call that is cancelled before it is made leaves the worker with what it was told to dance to', async () => {
  vi.stubGlobal('Worker', NotingWorker);
  vi.stubGlobal('document', { baseURI: 'https://dance.example/' });
  const generator = await createGenerator({ manifestUrl: 'manifest.json' });
  const settings = { seed: 1, musicGuidance: 1, variety: 1, guidance: new Float32Array(0) };
  const leader = still(30);
  const request = (role: 'reactor' | 'leader') => ({
    leader,
    fitted: leader,
    music: null,
    role,
    ...settings,
  });
  await generator.generate(request('reactor'));
  const cancelled = new AbortController();
  const never = generator.generate(request('leader'), { signal: cancelled.signal });
  cancelled.abort();
  await expect(never).rejects.toThrow(cancelled.signal.reason as DOMException);
  await generator.generate(request('leader'));
  await generator.generate(request('leader'));
  expect(NotingWorker.told).toEqual(['reactor', 'leader', null]);
  generator.dispose();
});
