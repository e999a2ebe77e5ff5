/** The shipped model's graphs in onnxruntime's wasm build, held against PyTorch. */
import { describe, expect, it } from 'vitest';
import { goldenError } from '../../../../web/model/load/golden';
import { openModel, otherFiles } from '../../support/open-model';

const folder = new URL('../../../../web/public/models/salsa/', import.meta.url);

describe('the shipped model', () => {
  it('is the one its manifest lists, and dances as in Python, to a millimetre', async () => {
    const { manifest, session, golden } = await openModel(folder);
    expect(otherFiles(folder, manifest)).toEqual([]);
    expect(await goldenError(manifest, session, golden)).toBeLessThan(1e-3);
    await session.release();
  }, 120_000);

  it('dances nearly so with products in 8 bits: at the worst joint and frame to a decimetre', async () => {
    // The mean over joints and frames is what export/verify.py holds, to half a centimetre.
    const { manifest, session, golden } = await openModel(folder, 'wasm');
    expect(await goldenError(manifest, session, golden)).toBeLessThan(0.1);
    await session.release();
  }, 120_000);
});
