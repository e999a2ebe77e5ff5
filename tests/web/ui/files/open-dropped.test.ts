import { describe, expect, it } from 'vitest';
import type { DroppedFile } from '../../../../web/ui/store/services';
import { openDropped } from '../../../../web/ui/files/open-dropped';
import { createAppStore } from '../../../../web/ui/store/store';

function page(modelOpens = true) {
  const store = createAppStore('dark');
  const happened: string[] = [];
  const open = (coming: Promise<readonly DroppedFile[]>): Promise<void> =>
    openDropped(
      coming,
      store,
      { open: (files) => Promise.resolve(void happened.push(...files.map(({ name }) => name))) },
      {
        open: (folder) => {
          happened.push(`model of ${Object.keys(folder).join(', ')}`);
          return Promise.resolve(modelOpens);
        },
      },
      () => happened.push('generate'),
    );
  return { store, happened, open };
}

const file = (path: string): DroppedFile => ({ path, file: new File(['x'], path.split('/').at(-1) ?? '') });

describe('what is dropped', () => {
  it('is files, or the folder of a model', async () => {
    const { happened, open } = page();
    await open(Promise.resolve([file('a.mp3'), file('b.bvh')]));
    await open(Promise.resolve([file('m/manifest.json'), file('m/step.onnx')]));
    expect(happened).toEqual(['a.mp3', 'b.bvh', 'model of manifest.json, step.onnx', 'generate']);
  });

  it('is not danced to when its model did not open', async () => {
    const { happened, open } = page(false);
    await open(Promise.resolve([file('m/manifest.json')]));
    expect(happened).toEqual(['model of manifest.json']);
  });

  it.each([
    ['NotFoundError', /could not be read/],
    ['NotReadableError', /may not read/],
  ])('is told about when it fails with %s', async (name, title) => {
    const { store, happened, open } = page();
    await open(Promise.reject(new DOMException('gone', name)));
    expect(store.getState().problem?.title).toMatch(title);
    expect(store.getState().problem?.hint).toMatch(/drop it again/);
    expect(happened).toEqual([]);
  });

  it('is told about when there is nothing in it', async () => {
    const { store, open } = page();
    await open(Promise.resolve([]));
    expect(store.getState().problem?.code).toBe('drop-empty');
  });
});
