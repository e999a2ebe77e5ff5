import { serve, type TaskContext, type Tasks } from '../../../web/common/serve-tasks';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { AppError } from '../../../web/common/error';
import { yieldToEvents } from '../../../web/common/yield-to-events';
import { runInWorker, WorkerConnection } from '../../../web/common/run-in-worker';

const seen: { signal?: AbortSignal; buffers: ArrayBuffer[]; counted: number } = { buffers: [], counted: 0 };

const tasks = {
  double(
    { values }: { values: Float32Array },
    { report }: TaskContext<{ half: Float32Array }>,
  ): Float32Array {
    void report({ half: values.map((value) => value / 2) });
    const doubled = values.map((value) => 2 * value);
    seen.buffers.push(doubled.buffer);
    return doubled;
  },
  count({ to }: { to: number }, { report }: TaskContext<number>): number {
    for (let at = 1; at <= to; at++) void report(at);
    return to;
  },
  /** Counts until the page has had enough, which it says when it takes a number. */
  async countUntilAborted(_: object, { signal, report }: TaskContext<number>): Promise<number> {
    for (let at = 1; ; at++) {
      seen.counted = at;
      await report(at);
      await yieldToEvents(signal);
    }
  },
  refuse: (_: object): never => {
    throw new AppError('bad-request', 'It has no frames.', 'Give it some.');
  },
  crash: (_: object): never => {
    throw new RangeError('out of range');
  },
  wait: (_: object, { signal }: TaskContext<never>): Promise<void> => {
    seen.signal = signal;
    return new Promise((_resolve, reject) =>
      signal.addEventListener('abort', () => reject(signal.reason as Error)),
    );
  },
};
type Tested = typeof tasks;

/** A picture as Node has it: a port can be transferred and closed too, and the one at its other end hears of that. */
function picture(): { image: ImageBitmap; closed: Promise<unknown> } {
  const { port1, port2 } = new MessageChannel();
  const closed = new Promise((resolve) => port2.addEventListener('close', resolve));
  return { image: port1 as unknown as ImageBitmap, closed };
}

/** Reports a picture at once and another when the call is cancelled, and ends with one more. */
function pictures(drawn: ReturnType<typeof picture>[]) {
  return {
    async draw(
      _: object,
      { signal, report }: TaskContext<{ image: ImageBitmap }>,
    ): Promise<{ image: ImageBitmap }> {
      const [first, second, last] = drawn;
      void report({ image: first!.image });
      await new Promise((resolve) => signal.addEventListener('abort', resolve));
      void report({ image: second!.image });
      return { image: last!.image };
    },
  };
}

/** A worker on this thread. */
class LocalWorker extends EventTarget {
  readonly #channel = new MessageChannel();
  terminated = false;
  /** Neither hears nor says anything, like a worker in an endless loop or one that was killed. */
  silent = false;

  constructor(served: Tasks = tasks) {
    super();
    serve(served, this.#channel.port2);
    this.#channel.port1.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
      if (!this.silent) this.dispatchEvent(new MessageEvent('message', { data }));
    });
    this.#channel.port1.start();
    opened.push(this);
  }

  postMessage(message: unknown, transfers: Transferable[] = []): void {
    if (!this.silent) this.#channel.port1.postMessage(message, transfers);
  }

  terminate(): void {
    this.terminated = true;
    this.#channel.port1.close();
  }
}

const opened: LocalWorker[] = [];
const open = (): Worker => new LocalWorker() as unknown as Worker;
const fail = (worker: Worker, message: string): void => {
  worker.dispatchEvent(Object.assign(new Event('error', { cancelable: true }), { message }));
};

afterEach(() => {
  for (const worker of opened.splice(0)) worker.terminate();
  vi.unstubAllGlobals();
  delete seen.signal;
  seen.buffers.length = 0;
});

describe('a connection to a worker', () => {
  it('receives every report before the output', async () => {
    const reports: number[] = [];
    const output = await runInWorker<Tested, 'count'>(
      open(),
      'count',
      { to: 20 },
      { onReport: (at) => reports.push(at) },
    );
    expect(output).toBe(20);
    expect(reports).toEqual(Array.from({ length: 20 }, (_, i) => i + 1));
  });

  it('waits with a task that awaits its report until the page has taken it, and may have cancelled the task', async () => {
    const connection = new WorkerConnection<Tested>(open());
    const controller = new AbortController();
    const counting = connection.call(
      'countUntilAborted',
      {},
      {
        signal: controller.signal,
        onReport: async (at) => {
          if (at < 3) return;
          await new Promise((resolve) => setTimeout(resolve, 20));
          controller.abort();
        },
      },
    );
    await expect(counting).rejects.toThrow(/abort/i);
    // A later call is answered after whatever the task might still have done.
    await connection.call('count', { to: 9 });
    expect(seen.counted).toBe(3);
  });

  it('answers several calls at once, with reports, and transfers the buffers of the output', async () => {
    const connection = new WorkerConnection<Tested>(open());
    const values = Float32Array.of(1, 2);
    const reports: { half: Float32Array }[] = [];
    const answers = await Promise.all([
      connection.call('double', { values }, { onReport: (report) => reports.push(report) }),
      connection.call('double', { values: Float32Array.of(5) }),
    ]);
    expect(answers).toEqual([Float32Array.of(2, 4), Float32Array.of(10)]);
    expect(reports).toEqual([{ half: Float32Array.of(0.5, 1) }]);
    // The input was copied, the output left the worker.
    expect(values).toHaveLength(2);
    expect(seen.buffers.map((buffer) => buffer.byteLength)).toEqual([0, 0]);
    await connection.call('double', { values }, { transfers: [values.buffer] });
    expect(values).toHaveLength(0);
  });

  it('transfers pictures too, and closes those that come after the call was cancelled', async () => {
    vi.stubGlobal('ImageBitmap', MessagePort);
    const drawn = [picture(), picture(), picture()];
    const worker = new LocalWorker(pictures(drawn)) as unknown as Worker;
    const connection = new WorkerConnection<ReturnType<typeof pictures>>(worker);
    const controller = new AbortController();
    const taken: ImageBitmap[] = [];
    const drawing = connection.call(
      'draw',
      {},
      { signal: controller.signal, onReport: ({ image }) => taken.push(image) },
    );
    await vi.waitFor(() => expect(taken).toHaveLength(1));
    controller.abort();
    await expect(drawing).rejects.toBe(controller.signal.reason);
    await Promise.all([drawn[1]!.closed, drawn[2]!.closed]);
    expect(taken).toHaveLength(1);
    // The first is the caller's, which closes it.
    taken[0]!.close();
    await drawn[0]!.closed;
  });

  it('rejects with the error of the task and takes further calls', async () => {
    const connection = new WorkerConnection<Tested>(open());
    const error = await connection.call('refuse', {}).catch((reason: unknown) => reason);
    expect(error).toBeInstanceOf(AppError);
    expect(error).toMatchObject({ code: 'bad-request', message: 'It has no frames.', hint: 'Give it some.' });
    expect(connection.ended).toBe(false);
    expect(await connection.call('double', { values: Float32Array.of(1) })).toEqual(Float32Array.of(2));
  });

  it('rejects at once when it is cancelled, aborts the signal of the task, and takes further calls', async () => {
    const connection = new WorkerConnection<Tested>(open());
    const controller = new AbortController();
    const waiting = connection.call('wait', {}, { signal: controller.signal });
    await vi.waitFor(() => expect(seen.signal?.aborted).toBe(false));
    controller.abort();
    await expect(waiting).rejects.toBe(controller.signal.reason);
    await vi.waitFor(() => expect(seen.signal?.aborted).toBe(true));
    await expect(connection.call('wait', {}, { signal: controller.signal })).rejects.toBe(
      controller.signal.reason,
    );
    expect(await connection.call('double', { values: Float32Array.of(1) })).toEqual(Float32Array.of(2));
  });

  it('ends with an unforeseen error, which `toError` makes', async () => {
    const worker = open();
    const connection = new WorkerConnection<Tested>(worker, {
      toError: (reason) => new Error(`Stopped: ${reason}`),
    });
    const waiting = connection.call('wait', {});
    const both = Promise.allSettled([waiting, connection.call('crash', {})]);
    expect(await both).toMatchObject([
      { status: 'rejected', reason: { message: 'Stopped: out of range' } },
      { status: 'rejected', reason: { message: 'Stopped: out of range' } },
    ]);
    expect(connection.ended).toBe(true);
    expect(worker).toHaveProperty('terminated', true);
    await expect(connection.call('double', { values: Float32Array.of(1) })).rejects.toThrow('out of range');
  });

  it.each([
    "Can't create a session. ERROR_CODE: 6, ERROR_MESSAGE: std::bad_alloc",
    'WebAssembly.Memory(): could not allocate memory',
    'Array buffer allocation failed',
    'Aborted(OOM)',
  ])('says what to do where memory cannot be had: %s', async (reason) => {
    const worker = open();
    const waiting = new WorkerConnection<Tested>(worker).call('wait', {});
    fail(worker, reason);
    await expect(waiting).rejects.toMatchObject({
      code: 'out-of-memory',
      hint: expect.stringContaining('Close other tabs') as string,
    });
  });

  it.each([
    ['an error of its script', 'the roof fell in', 'the roof fell in'],
    ['a script that is not there', '', 'A part of this page could not be loaded.'],
  ])('ends with %s', async (_, message, reason) => {
    const worker = open();
    const connection = new WorkerConnection<Tested>(worker);
    const waiting = connection.call('wait', {});
    fail(worker, message);
    await expect(waiting).rejects.toThrow(reason);
    expect(connection.ended).toBe(true);
  });

  it('rejects running calls when it is disposed of', async () => {
    const connection = new WorkerConnection<Tested>(open());
    const waiting = connection.call('wait', {});
    connection.dispose();
    await expect(waiting).rejects.toMatchObject({ name: 'AbortError' });
  });
});

describe('a worker that falls silent', () => {
  const timeouts = { first: 0.3, next: 0.15 };
  const silenced = (): LocalWorker => Object.assign(new LocalWorker(), { silent: true });

  it('in the middle of a task ends, and the call fails with the time waited', async () => {
    const worker = new LocalWorker();
    const connection = new WorkerConnection<Tested>(worker as unknown as Worker, { timeouts });
    await connection.call('double', { values: Float32Array.of(1) });
    const waiting = connection.call('wait', {});
    worker.silent = true;
    await expect(waiting).rejects.toThrow('no answer for 0.15 seconds');
    expect(connection.ended).toBe(true);
    expect(worker.terminated).toBe(true);
  });

  it('before its script has come is given more time', async () => {
    const connection = new WorkerConnection<Tested>(silenced() as unknown as Worker, { timeouts });
    await expect(connection.call('wait', {})).rejects.toThrow('no answer for 0.3 seconds');
  });

  it('after its call was cancelled ends as well, so that the next call can have a new one', async () => {
    const worker = new LocalWorker();
    const connection = new WorkerConnection<Tested>(worker as unknown as Worker, { timeouts });
    const controller = new AbortController();
    const waiting = connection.call('wait', {}, { signal: controller.signal });
    worker.silent = true;
    controller.abort();
    await expect(waiting).rejects.toBe(controller.signal.reason);
    expect(connection.ended).toBe(false);
    await vi.waitFor(() => expect(connection.ended).toBe(true));
  });

  /** Three times the wait. */
  const longTime = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 3000 * timeouts.first));

  it('is not one that takes long but lets messages in', async () => {
    const connection = new WorkerConnection<Tested>(open(), { timeouts });
    const controller = new AbortController();
    const waiting = connection.call('wait', {}, { signal: controller.signal });
    await longTime();
    expect(connection.ended).toBe(false);
    controller.abort();
    await expect(waiting).rejects.toThrow(/abort/i);
  });

  it('is not one that has nothing to do', async () => {
    const worker = new LocalWorker();
    const connection = new WorkerConnection<Tested>(worker as unknown as Worker, { timeouts });
    await connection.call('count', { to: 1 });
    worker.silent = true;
    await longTime();
    expect(connection.ended).toBe(false);
  });
});

describe('a task in a worker of its own', () => {
  it.each([
    ['done', 'double', true],
    ['refused', 'refuse', false],
  ] as const)('ends the worker when it is %s', async (_, name, succeeds) => {
    const worker = open();
    const values = Float32Array.of(1);
    const result = runInWorker<Tested, typeof name>(worker, name, { values });
    await (succeeds ? result : expect(result).rejects.toThrow(AppError));
    expect(worker).toHaveProperty('terminated', true);
  });

  it('ends the worker at once when it is cancelled', async () => {
    const worker = open();
    const controller = new AbortController();
    const result = runInWorker<Tested, 'wait'>(worker, 'wait', {}, { signal: controller.signal });
    controller.abort();
    await expect(result).rejects.toBe(controller.signal.reason);
    expect(worker).toHaveProperty('terminated', true);
  });
});

describe('a worker that has ended', () => {
  it('is collected as garbage, and with it what it was given', async () => {
    setFlagsFromString('--expose_gc');
    const collectGarbage = runInNewContext('gc') as () => void;
    const used = async (): Promise<WeakRef<object>[]> => {
      const worker = new LocalWorker();
      opened.length = 0;
      const values = new Float32Array(4);
      const onReport = (): void => undefined;
      await runInWorker<Tested, 'double'>(worker as unknown as Worker, 'double', { values }, { onReport });
      return [worker, values, onReport].map((part) => new WeakRef(part));
    };
    const parts = await used();
    await vi.waitFor(() => {
      collectGarbage();
      expect(parts.map((part) => part.deref() === undefined)).toEqual([true, true, true]);
    }, 5000);
  });
});
