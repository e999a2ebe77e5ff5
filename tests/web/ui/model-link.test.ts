import { describe, expect, it } from 'vitest';
import { ModelError, type Generator, type Status } from '../../../web/model/client';
import { createModelLink } from '../../../web/ui/model-link';
import { createAppStore } from '../../../web/ui/store';
import { small } from '../model/small-manifest';

const generator = { manifest: small } as Generator;
const backend = { name: 'wasm', reason: 'Processor, 2 threads: no WebGPU.', threads: 2 } as const;

function loading() {
  const store = createAppStore('dark');
  const attempts: {
    tell: (status: Status) => void;
    succeed: (made: Generator) => void;
    fail: (error: Error) => void;
  }[] = [];
  const link = createModelLink(
    store,
    (tell) => new Promise((succeed, fail) => attempts.push({ tell, succeed, fail })),
  );
  return { store, link, attempts };
}

describe('loading the model', () => {
  it('shows bytes, then what it prepares, then where it computes', async () => {
    const { store, link, attempts } = loading();
    const [attempt] = attempts;
    attempt?.tell({ kind: 'manifest', manifest: small });
    expect(store.getState().settings?.steps).toBe(10);
    expect(await link.manifest()).toBe(small);
    attempt?.tell({ kind: 'download', loaded: 5, total: 9 });
    expect(store.getState().model).toEqual({ phase: 'loading', label: 'Model', received: 5, total: 9 });
    attempt?.tell({ kind: 'warm-up' });
    expect(store.getState().model).toMatchObject({ phase: 'loading', label: 'Warming up', total: 0 });
    attempt?.tell({ kind: 'ready', backend });
    expect(store.getState().model).toEqual({
      phase: 'ready',
      backend: 'wasm',
      reason: backend.reason,
      threads: 2,
    });
    attempt?.succeed(generator);
    expect(await link.generator()).toBe(generator);
  });

  it('tells a failure in words and can try again, keeping settings', async () => {
    const { store, link, attempts } = loading();
    attempts[0]?.tell({ kind: 'manifest', manifest: small });
    const { settings } = store.getState();
    attempts[0]?.fail(new ModelError('model-missing', 'The server answered 404.', 'Copy the model folder.'));
    await expect(link.generator()).rejects.toThrow('404');
    expect(store.getState().problem).toMatchObject({ code: 'model-missing', remedy: 'model' });
    expect(store.getState().model.phase).toBe('failed');
    link.retry();
    attempts[1]?.tell({ kind: 'manifest', manifest: small });
    attempts[1]?.tell({ kind: 'ready', backend });
    attempts[1]?.succeed(generator);
    expect(await link.generator()).toBe(generator);
    expect(store.getState().settings).toBe(settings);
  });

  it('does not load twice', () => {
    const { link, attempts } = loading();
    link.retry();
    expect(attempts).toHaveLength(1);
  });

  it('keeps what is worth knowing as a remark', () => {
    const { store, attempts } = loading();
    attempts[0]?.tell({ kind: 'notice', code: 'not-kept', message: 'Not kept.', hint: 'Free some space.' });
    expect(store.getState().remarks).toEqual(['Not kept. Free some space.']);
    expect(store.getState().problem).toBeNull();
  });
});
