/** What a page, its workers and its process use, as Chromium says. */
import { readFileSync } from 'node:fs';
import type { Browser, CDPSession, Page } from '@playwright/test';

/** Megabytes. */
export interface Memory {
  /** Objects of the page. */
  readonly heap: number;
  /** Array buffers that songs, leaders, takes and steps of undo hold. */
  readonly held: number;
  /** All other array buffers of the page. */
  readonly buffers: number;
  /** Elements and the like that scripts hold on to. */
  readonly elements: number;
  /** Objects and array buffers of all workers, WebAssembly among the latter. */
  readonly workers: number;
  /** Resident memory of all processes that draw pages. */
  readonly process: number;
  /** Resident memory of the process that holds files and databases for them. */
  readonly browser: number;
}

interface HeapUsage {
  readonly usedSize: number;
  readonly embedderHeapUsedSize: number;
  readonly backingStorageSize: number;
}

const MEGABYTE = 2 ** 20;

/** Bytes of all array buffers that the page's state refers to. */
const HELD = `(() => {
  const seen = new Set();
  let bytes = 0;
  const visit = (value) => {
    if (typeof value !== 'object' || value === null || seen.has(value)) return;
    seen.add(value);
    if (value instanceof ArrayBuffer) bytes += value.byteLength;
    else if (ArrayBuffer.isView(value)) visit(value.buffer);
    else if (!(value instanceof Blob)) Object.values(value).forEach(visit);
  };
  visit(window.reactdance.store.getState());
  return bytes;
})()`;

/** Measures the memory of a page; to be made before the page opens its workers. */
export class MemoryMeter {
  readonly #workers = new Set<string>();
  readonly #answers = new Map<number, (result: HeapUsage | null) => void>();
  #asked = 0;

  private constructor(
    readonly page: CDPSession,
    readonly browser: CDPSession,
    private readonly dropRecords: () => Promise<void>,
  ) {
    page.on('Target.attachedToTarget', ({ sessionId }) => this.#workers.add(sessionId));
    page.on('Target.detachedFromTarget', ({ sessionId }) => {
      this.#workers.delete(sessionId);
    });
    page.on('Target.receivedMessageFromTarget', ({ message }) => {
      const { id, result } = JSON.parse(message) as { id?: number; result?: HeapUsage };
      if (id !== undefined) this.#answers.get(id)?.(result ?? null);
    });
  }

  static async open(page: Page, browser: Browser): Promise<MemoryMeter> {
    const dropRecords = networkRecorder(page);
    await dropRecords();
    const meter = new MemoryMeter(
      await page.context().newCDPSession(page),
      await browser.newBrowserCDPSession(),
      dropRecords,
    );
    await meter.page.send('HeapProfiler.enable');
    await meter.page.send('Target.setAutoAttach', {
      autoAttach: true,
      waitForDebuggerOnStart: false,
      flatten: false,
    });
    return meter;
  }

  /** After a collection of garbage on all threads. */
  async measure(): Promise<Memory> {
    await this.dropRecords();
    // What only a collected object held is collected the second time.
    for (let times = 0; times < 2; times++) await this.page.send('HeapProfiler.collectGarbage');
    const own = await this.page.send('Runtime.getHeapUsage');
    let workers = 0;
    for (const session of this.#workers) {
      await this.#ask(session, 'HeapProfiler.collectGarbage');
      const usage = await this.#ask(session, 'Runtime.getHeapUsage');
      workers += usage ? usage.usedSize + usage.backingStorageSize : 0;
    }
    const { result } = await this.page.send('Runtime.evaluate', { expression: HELD, returnByValue: true });
    const held = Number(result.value);
    return {
      heap: own.usedSize / MEGABYTE,
      held: held / MEGABYTE,
      buffers: (own.backingStorageSize - held) / MEGABYTE,
      elements: own.embedderHeapUsedSize / MEGABYTE,
      workers: workers / MEGABYTE,
      process: await this.#resident('renderer'),
      browser: await this.#resident('browser'),
    };
  }

  /** Null from a worker that has ended. */
  #ask(sessionId: string, method: string): Promise<HeapUsage | null> {
    const id = ++this.#asked;
    return new Promise((resolve) => {
      const answer = (result: HeapUsage | null): void => {
        this.#answers.delete(id);
        this.page.off('Target.detachedFromTarget', ended);
        resolve(result);
      };
      const ended = (event: { sessionId: string }): void => {
        if (event.sessionId === sessionId) answer(null);
      };
      this.#answers.set(id, answer);
      this.page.on('Target.detachedFromTarget', ended);
      const message = JSON.stringify({ id, method, params: {} });
      this.page.send('Target.sendMessageToTarget', { sessionId, message }).catch(() => answer(null));
    });
  }

  async #resident(kind: string): Promise<number> {
    const { processInfo } = await this.browser.send('SystemInfo.getProcessInfo');
    let kilobytes = 0;
    for (const { type, id } of processInfo)
      if (type === kind) kilobytes += Number(/VmRSS:\s+(\d+)/.exec(status(id))?.[1] ?? 0);
    return kilobytes / 1024;
  }
}

/** The parts of Playwright that have no public way to them. */
interface Internals {
  readonly _connection: {
    toImpl(page: Page): {
      readonly delegate: {
        readonly _mainFrameSession: {
          readonly _client: { send(method: string, parameters: object): Promise<unknown> };
        };
      };
    };
  };
}

/**
 * Has Chromium keep no copies of what the page reads. It does so for Playwright, as for open developer tools, in the
 * page's process: five of every song, up to 100 MB, which would be taken for memory of the page. It also keeps a record
 * of every request.
 *
 * @returns drops the records until now
 */
function networkRecorder(page: Page): () => Promise<void> {
  const { _mainFrameSession } = (page as unknown as Internals)._connection.toImpl(page).delegate;
  const nothing = { maxTotalBufferSize: 0, maxResourceBufferSize: 0 };
  return async () => {
    await _mainFrameSession._client.send('Network.disable', {});
    await _mainFrameSession._client.send('Network.enable', nothing);
  };
}

/** Linux's description of a process; empty elsewhere and where it has ended. */
function status(id: number): string {
  try {
    return readFileSync(`/proc/${id}/status`, 'utf8');
  } catch {
    return '';
  }
}
