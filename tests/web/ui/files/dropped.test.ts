import { strToU8, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import type { DroppedFile } from '../../../../web/ui/store/services';
import { createInOrder, droppedFiles, modelFolder, openDropped } from '../../../../web/ui/files/dropped';
import { createAppStore } from '../../../../web/ui/store/store';

const dropped = (...paths: string[]) => paths.map((path) => ({ path, file: new File([path], path) }));

/** A folder or a file as browsers give it. */
function entry(path: string, ...below: object[]): object {
  const fullPath = `/${path}`;
  if (below.length === 0) {
    const give = (resolve: (one: File) => void): void => {
      resolve(new File(['x'], path.split('/').at(-1)!));
    };
    return { isFile: true, isDirectory: false, fullPath, file: give };
  }
  const batches = [below, []];
  const readEntries = (resolve: (batch: object[]) => void): void => {
    resolve(batches.shift()!);
  };
  return { isFile: false, isDirectory: true, fullPath, createReader: () => ({ readEntries }) };
}

it('a dropped folder gives its files, without those that systems put there', async () => {
  const folder = entry(
    '.dance',
    entry('.dance/.DS_Store'),
    entry('.dance/a.bvh'),
    entry('.dance/songs', entry('.dance/songs/b.mp3'), entry('.dance/songs/desktop.ini')),
  );
  const items = [{ webkitGetAsEntry: () => folder }];
  const found = await droppedFiles({ items, files: [] } as unknown as DataTransfer);
  expect(found.map(({ path }) => path)).toEqual(['.dance/a.bvh', '.dance/songs/b.mp3']);
});

describe('the model among dropped files', () => {
  it('is the folder of the manifest, wherever it lies', () => {
    for (const root of ['', 'tango/', 'my models/tango/'])
      expect(
        Object.keys(
          modelFolder(dropped(`${root}step.onnx`, `${root}manifest.json`, `${root}parts/a.onnx`)) ?? {},
        ),
      ).toEqual(['step.onnx', 'manifest.json', 'parts/a.onnx']);
  });

  it('leaves out what lies beside the model', () => {
    const model = modelFolder(
      dropped('song.mp3', 'tango/manifest.json', 'tango/step.onnx', 'salsa/step.onnx'),
    );
    expect(Object.keys(model ?? {})).toEqual(['manifest.json', 'step.onnx']);
  });

  it('is missing without a manifest', () => {
    expect(modelFolder(dropped('song.mp3', 'leader.bvh', 'not-a-manifest.json'))).toBeNull();
  });
});

function page(modelOpens = true) {
  const store = createAppStore('dark');
  const happened: string[] = [];
  const inOrder = createInOrder();
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
      inOrder,
    );
  return { store, happened, open };
}

const file = (path: string): DroppedFile => ({ path, file: new File(['x'], path.split('/').at(-1) ?? '') });

describe('opening dropped files', () => {
  it('opens songs and leaders, or the folder of a model', async () => {
    const { happened, open } = page();
    await open(Promise.resolve([file('a.mp3'), file('b.bvh')]));
    await open(Promise.resolve([file('m/manifest.json'), file('m/step.onnx')]));
    expect(happened).toEqual(['a.mp3', 'b.bvh', 'model of manifest.json, step.onnx', 'generate']);
  });

  it('opens what was dropped later after what was dropped before, however long that takes', async () => {
    const { happened, open } = page();
    let folderRead: (files: DroppedFile[]) => void = () => undefined;
    const folder = open(new Promise((resolve) => (folderRead = resolve)));
    const later = open(Promise.resolve([file('later.bvh')]));
    await Promise.resolve();
    folderRead([file('earlier.bvh')]);
    await Promise.all([folder, later]);
    expect(happened).toEqual(['earlier.bvh', 'later.bvh']);
  });

  it('opens what lies in a zip archive, also a model, and reports an archive that cannot be unpacked', async () => {
    const { store, happened, open } = page();
    const zip = (name: string, content: Uint8Array<ArrayBuffer>): DroppedFile => ({
      path: name,
      file: new File([content], name),
    });
    await open(Promise.resolve([zip('takes.zip', zipSync({ 'a.bvh': strToU8('x') }))]));
    const model = zipSync({ tango: { 'manifest.json': strToU8('{}'), 'step.onnx': strToU8('x') } });
    await open(Promise.resolve([zip('tango.zip', model)]));
    await open(Promise.resolve([zip('cut.zip', model.slice(0, 40)), file('b.bvh')]));
    expect(happened).toEqual(['a.bvh', 'model of manifest.json, step.onnx', 'generate']);
    expect(store.getState().problem?.code).toBe('archive-damaged');
  });

  it('generates nothing when the model did not open', async () => {
    const { happened, open } = page(false);
    await open(Promise.resolve([file('m/manifest.json')]));
    expect(happened).toEqual(['model of manifest.json']);
  });

  it.each([
    ['NotFoundError', /could be read/],
    ['NotReadableError', /not allowed to read/],
  ])('reports a drop that fails with %s', async (name, title) => {
    const { store, happened, open } = page();
    await open(Promise.reject(new DOMException('gone', name)));
    expect(store.getState().problem?.title).toMatch(title);
    expect(store.getState().problem?.hint).toMatch(/drop it again/);
    expect(happened).toEqual([]);
  });

  it('reports an empty drop', async () => {
    const { store, open } = page();
    await open(Promise.resolve([]));
    expect(store.getState().problem?.code).toBe('drop-empty');
  });
});
