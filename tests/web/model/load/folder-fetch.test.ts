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
});
