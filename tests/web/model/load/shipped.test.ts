/** The shipped model's graphs in onnxruntime's wasm build, held against PyTorch. */
import { existsSync } from 'node:fs';
import { expect, it } from 'vitest';
import { goldenError } from '../../../../web/model/load/golden';
import { openModel } from '../../support/open-model';

const folder = new URL('../../../../web/public/models/salsa/', import.meta.url);

it.skipIf(!existsSync(folder))(
  'the shipped model dances as in Python, to a millimetre',
  async () => {
    const { manifest, session, golden } = await openModel(folder);
    expect(await goldenError(manifest, session, golden)).toBeLessThan(1e-3);
    await session.release();
  },
  120_000,
);
