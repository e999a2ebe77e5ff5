import { describe, expect, it } from 'vitest';
import { fetchFile, folderFetch } from '../../../../web/model/load/download';

const ROOT = 'https://page.example/models/manifest.json';
const get = folderFetch(
  { 'manifest.json': new Blob(['{"a": 1}']), 'parts/step.onnx': new Blob(['abc']) },
  ROOT,
);

describe('a folder of files', () => {
  it('answers for the paths that the manifest lists', async () => {
    expect(await (await fetchFile(ROOT, get)).json()).toEqual({ a: 1 });
    const part = new URL('parts/step.onnx', ROOT).href;
    expect(await (await fetchFile(part, get)).text()).toBe('abc');
  });

  it('reports a missing file by name', async () => {
    await expect(fetchFile(new URL('decode.onnx', ROOT).href, get)).rejects.toMatchObject({
      code: 'model-missing',
      message: expect.stringContaining('decode.onnx') as string,
    });
  });

  it('says that a file was moved since it was given, and to drop the folder again', async () => {
    const moved = new Blob(['abc']);
    moved.arrayBuffer = () => Promise.reject(new DOMException('gone', 'NotFoundError'));
    const path = new URL('step.onnx', ROOT).href;
    await expect(fetchFile(path, folderFetch({ 'step.onnx': moved }, ROOT))).rejects.toMatchObject({
      code: 'model-missing',
      message: expect.stringMatching(/step\.onnx .*moved/) as string,
      hint: expect.stringContaining('Drop the whole folder') as string,
    });
  });
});
