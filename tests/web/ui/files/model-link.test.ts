import { describe, expect, it } from 'vitest';
import { AppError } from '../../../../web/common/error';
import type { Generator, ModelFolder, ReloadFailure, Status } from '../../../../web/model/client';
import { ModelLink } from '../../../../web/ui/files/model-link';
import type { LoadedSong } from '../../../../web/ui/store/reaction';
import { createAppStore } from '../../../../web/ui/store/store';
import { small } from '../../support/small-manifest';

const generator = { manifest: small } as Generator;
const backend = { name: 'wasm', reason: 'Processor, 2 threads: no WebGPU.', threads: 2 } as const;

function loading() {
  const store = createAppStore('dark');
  const attempts: {
    tell: (status: Status | ReloadFailure) => void;
    succeed: (made: Generator) => void;
    fail: (error: Error) => void;
    folder: ModelFolder | null;
  }[] = [];
  const link = new ModelLink(
    store,
    (tell, folder) => new Promise((succeed, fail) => attempts.push({ tell, succeed, fail, folder })),
  );
  return { store, link, attempts };
}

describe('loading the model', () => {
  it('shows bytes, then what is prepared, then the backend', async () => {
    const { store, link, attempts } = loading();
    const [attempt] = attempts;
    attempt?.tell({ kind: 'manifest', manifest: small });
    expect(store.getState().settings?.music).toBe(2);
    expect(await link.manifest()).toBe(small);
    const parts = [
      { name: 'runtime', loaded: 4, total: 4, cached: 4 },
      { name: 'model', loaded: 1, total: 5, cached: 0 },
    ] as const;
    attempt?.tell({ kind: 'download', parts });
    expect(store.getState().model).toEqual({
      phase: 'loading',
      label: 'Model',
      received: 5,
      total: 9,
      parts,
    });
    attempt?.tell({ kind: 'warm-up' });
    expect(store.getState().model).toMatchObject({ phase: 'loading', label: 'Warming up', total: 0 });
    attempt?.tell({ kind: 'ready', backend });
    expect(store.getState().model).toEqual({
      phase: 'ready',
      backend: 'wasm',
      reason: backend.reason,
    });
    attempt?.succeed(generator);
    expect(await link.generator()).toBe(generator);
  });

  it('shows that a model which was there could not be loaded again, and can try again', async () => {
    const { store, link, attempts } = loading();
    attempts[0]?.succeed(generator);
    await link.generator();
    attempts[0]?.tell({
      kind: 'failed',
      error: new AppError('download-failed', 'It stalled.', 'Try again.'),
    });
    expect(store.getState().model.phase).toBe('failed');
    expect(store.getState().problem).toMatchObject({ title: 'It stalled.', remedy: 'model' });
    link.retry();
    expect(attempts).toHaveLength(2);
  });

  it('shows a failure and can try again, keeping settings', async () => {
    const { store, link, attempts } = loading();
    attempts[0]?.tell({ kind: 'manifest', manifest: small });
    const { settings } = store.getState();
    attempts[0]?.fail(new AppError('model-missing', 'The server answered 404.', 'Copy the model folder.'));
    await expect(link.generator()).rejects.toThrow('404');
    expect(store.getState().problem).toMatchObject({ code: 'model-missing', remedy: 'model' });
    attempts[0]?.tell({ kind: 'download', parts: [{ name: 'runtime', loaded: 1, total: 4, cached: 0 }] });
    expect(store.getState().model.phase, 'a download beside the one that failed').toBe('failed');
    expect(link.retry()).toBe(true);
    expect(store.getState().problem).toBeNull();
    attempts[1]?.tell({ kind: 'manifest', manifest: small });
    attempts[1]?.tell({ kind: 'ready', backend });
    attempts[1]?.succeed(generator);
    expect(await link.generator()).toBe(generator);
    expect(store.getState().settings).toBe(settings);
  });

  it('does not load twice', () => {
    const { link, attempts } = loading();
    expect(link.retry()).toBe(false);
    expect(attempts).toHaveLength(1);
  });

  it('adds what is worth knowing to the notices', () => {
    const { store, attempts } = loading();
    attempts[0]?.tell({ kind: 'notice', code: 'not-cached', message: 'Not kept.', hint: 'Free some space.' });
    expect(store.getState().notices).toEqual(['Not kept. Free some space.']);
    expect(store.getState().problem).toBeNull();
  });
});

describe('opening a model of the visitor', () => {
  const folder = { 'manifest.json': new Blob(['{}']) };
  const other = { ...small, id: 'other', name: 'Tango' };

  async function danced() {
    const all = loading();
    let disposed = false;
    all.attempts[0]?.tell({ kind: 'manifest', manifest: small });
    all.attempts[0]?.tell({ kind: 'ready', backend });
    const present = { manifest: small, dispose: () => void (disposed = true) } as Generator;
    all.attempts[0]?.succeed(present);
    await all.link.generator();
    return { ...all, present, isDisposed: () => disposed };
  }

  it('replaces the present one when it is ready, and not before', async () => {
    const { store, link, attempts, present, isDisposed } = await danced();
    const opened = link.open(folder);
    expect(attempts[1]?.folder).toBe(folder);
    attempts[1]?.tell({ kind: 'manifest', manifest: other });
    expect(store.getState().manifest).toBe(small);
    expect(await link.generator()).toBe(present);
    attempts[1]?.tell({ kind: 'ready', backend });
    const made = { manifest: other } as Generator;
    attempts[1]?.succeed(made);
    expect(await opened).toBe(true);
    expect(store.getState().manifest).toBe(other);
    expect(await link.manifest()).toBe(other);
    expect(await link.generator()).toBe(made);
    expect(isDisposed()).toBe(true);
    expect(store.getState().notices.join()).toContain('Tango');
  });

  it('leaves everything as it was when it fails, and says why', async () => {
    const { store, link, attempts, present, isDisposed } = await danced();
    const before = store.getState();
    const opened = link.open(folder);
    attempts[1]?.tell({ kind: 'download', parts: [{ name: 'model', loaded: 1, total: 2, cached: 0 }] });
    attempts[1]?.fail(new AppError('model-missing', 'No step.onnx.', 'Take the whole folder.'));
    expect(await opened).toBe(false);
    const { problem, ...after } = store.getState();
    expect(problem).toMatchObject({ code: 'model-missing' });
    expect({ ...after, problem: null }).toEqual(before);
    expect(await link.generator()).toBe(present);
    expect(isDisposed()).toBe(false);
  });

  it('tries the folder again that failed, while the present model stays', async () => {
    const { store, link, attempts, present } = await danced();
    const opened = link.open(folder);
    attempts[1]?.fail(new AppError('download-failed', 'Nothing has arrived.', 'Try again.'));
    await opened;
    expect(store.getState()).toMatchObject({ problem: { remedy: 'own-model' }, model: { phase: 'ready' } });
    link.retry();
    expect(attempts, 'the page’s model has not failed').toHaveLength(2);
    const again = link.reopen();
    expect(attempts[2]?.folder).toBe(folder);
    expect(await link.generator()).toBe(present);
    attempts[2]?.succeed({ manifest: other } as Generator);
    expect(await again).toBe(true);
    expect(store.getState().manifest).toBe(other);
  });

  it('loads the visitor’s own model again, and not the page’s, after it could not be loaded again', async () => {
    const { store, link, attempts } = await danced();
    const opened = link.open(folder);
    const own = { manifest: other } as Generator;
    attempts[1]?.succeed(own);
    await opened;
    attempts[1]?.tell({ kind: 'failed', error: new AppError('download-failed', 'It is gone.', 'Look.') });
    expect(store.getState().model.phase).toBe('failed');
    link.retry();
    expect(attempts[2]?.folder).toBe(folder);
    attempts[2]?.tell({ kind: 'manifest', manifest: other });
    attempts[2]?.tell({ kind: 'ready', backend });
    attempts[2]?.succeed(own);
    expect(await link.generator()).toBe(own);
    expect(store.getState()).toMatchObject({ manifest: other, model: { phase: 'ready' } });
  });

  it('shows what has become of the page’s model meanwhile, when it fails', async () => {
    const { store, link, attempts } = loading();
    attempts[0]?.tell({ kind: 'manifest', manifest: small });
    const opened = link.open(folder);
    attempts[1]?.tell({ kind: 'warm-up' });
    attempts[0]?.tell({ kind: 'ready', backend });
    attempts[0]?.succeed(generator);
    await link.generator();
    expect(store.getState().model).toMatchObject({ phase: 'loading', label: 'Warming up' });
    attempts[1]?.fail(new AppError('model-mismatch', 'Not a model.', 'Take another folder.'));
    expect(await opened).toBe(false);
    expect(store.getState()).toMatchObject({
      model: { phase: 'ready', reason: backend.reason },
      problem: { code: 'model-mismatch' },
    });
  });

  it('keeps quiet about the page’s model that fails meanwhile, also to whom it was promised', async () => {
    const { store, link, attempts } = loading();
    const promised = link.generator().catch((error: unknown) => error);
    const opened = link.open(folder);
    attempts[0]?.fail(new AppError('download-failed', 'Nothing has arrived.', 'Try again.'));
    expect(await promised).toMatchObject({ name: 'AbortError' });
    expect(store.getState()).toMatchObject({ model: { phase: 'loading' }, problem: null });
    attempts[1]?.fail(new AppError('model-mismatch', 'Not a model.', 'Take another folder.'));
    await opened;
    expect(store.getState().model).toMatchObject({ phase: 'failed', problem: { code: 'download-failed' } });
  });

  it('hears no more of the page’s model, which may still be loading or fail', async () => {
    const { store, link, attempts } = loading();
    const opened = link.open(folder);
    attempts[1]?.tell({ kind: 'ready', backend });
    attempts[1]?.succeed({ manifest: other } as Generator);
    await opened;
    const before = store.getState();
    attempts[0]?.tell({ kind: 'manifest', manifest: small });
    attempts[0]?.tell({ kind: 'warm-up' });
    attempts[0]?.fail(new AppError('download-failed', 'Nothing has arrived.', 'Try again.'));
    await new Promise((resolve) => setTimeout(resolve));
    expect(store.getState()).toBe(before);
  });

  it('takes the folder that was given last', async () => {
    const { store, link, attempts, present } = await danced();
    const first = link.open(folder);
    const second = link.open({ 'manifest.json': new Blob(['{ }']) });
    let disposed = false;
    const late = { manifest: small, dispose: () => void (disposed = true) } as Generator;
    const made = { manifest: other } as Generator;
    attempts[2]?.succeed(made);
    expect(await second).toBe(true);
    attempts[1]?.succeed(late);
    expect(await first).toBe(false);
    expect(disposed).toBe(true);
    expect(await link.generator()).toBe(made);
    expect(await link.generator()).not.toBe(present);
    expect(store.getState().manifest).toBe(other);
  });

  it('removes a song that its audio recipe would analyse differently', async () => {
    for (const [audio, kept] of [
      [small.audio, true],
      [{ ...small.audio, hop: 2 * small.audio.hop }, false],
    ] as const) {
      const { store, link, attempts } = await danced();
      store.setState({ song: { name: 'a.mp3' } as LoadedSong });
      const opened = link.open(folder);
      attempts[1]?.succeed({ manifest: { ...other, audio } } as Generator);
      await opened;
      expect(store.getState().song !== null).toBe(kept);
      expect(store.getState().notices.join().includes('a.mp3')).toBe(!kept);
    }
  });
});
