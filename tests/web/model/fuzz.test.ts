import { parseManifest } from '../../../web/model/parse-manifest';
import { readFileSync } from 'node:fs';
import { zipSync, unzipSync } from 'fflate';
import { expect, test } from 'vitest';
import { readGolden } from '../../../web/model/load/golden';
import { ddim } from '../../../web/model/sample/schedule';
import { fuzz } from '../support/hostile/fuzz';
import { damagedBytes, damagedJson } from '../support/hostile/mutations';
import { smallJson } from '../support/small-manifest';

test('a damaged manifest is refused in a sentence or says what can be sampled', { timeout: 600_000 }, () => {
  const { refused } = fuzz(
    (random) => damagedJson(smallJson(), random),
    parseManifest,
    ({ fps, latent, diffusion, guidance }) => {
      expect(fps).toBe(30);
      expect(latent.channels % latent.streams.length).toBe(0);
      for (const { min, max, step } of [guidance.coarse, guidance.fine, guidance.music, guidance.variety])
        expect((max - min) / step).toBeGreaterThanOrEqual(0);
      for (const step of ddim(diffusion)) expect(Object.values(step).every(Number.isFinite)).toBe(true);
    },
  );
  expect(refused).toBeGreaterThan(0);
});

test('a damaged golden sampling is refused in a sentence or whole and finite', { timeout: 600_000 }, () => {
  const path = new URL('../../fixtures/tiny-model/golden.npz', import.meta.url);
  const read = unzipSync(readFileSync(path));
  const names = ['leader', 'music', 'music_valid', 'role', 'coarse', 'fine', 'music_guidance', 'seed'];
  const files = Object.fromEntries(
    [...names, 'reactor'].map((name) => [`${name}.npy`, short(read[`${name}.npy`]!)]),
  );
  expect(readGolden(zipSync(files, { level: 0 })).musicValid).toHaveLength(FRAMES);
  const keys = Object.keys(files);
  const { refused } = fuzz(
    (random) => {
      const key = keys[random(keys.length)]!;
      // Half of the damages are inside an array, where no checksum of the archive would find them.
      return random(2) === 0
        ? damagedBytes(zipSync(files, { level: 0 }), random)
        : zipSync({ ...files, [key]: damagedBytes(files[key]!, random) }, { level: 0 });
    },
    readGolden,
    (golden) => {
      expect(golden.leader).toHaveLength(golden.reactor.length);
      for (const values of [golden.leader, golden.music, golden.guidance, golden.reactor])
        expect(values.every((value) => Number.isFinite(value))).toBe(true);
      expect(Number.isInteger(golden.seed) && golden.seed >= 0).toBe(true);
    },
  );
  expect(refused).toBeGreaterThan(0);
});

/** Frames that are kept of the tensors over time. */
const FRAMES = 6;

/** A .npy file with the first `FRAMES` of 600 frames. */
function short(npy: Uint8Array): Uint8Array {
  const end = 10 + npy[8]! + 256 * npy[9]!;
  const header = new TextDecoder('latin1').decode(npy.subarray(10, end));
  if (!header.includes('(600,')) return npy;
  const changed = header.replace('(600,', `(${FRAMES},`).replace(/ (?=\n$)/, '   ');
  const body = npy.subarray(end, end + ((npy.length - end) / 600) * FRAMES);
  return Uint8Array.from([
    ...npy.subarray(0, 10),
    ...new TextEncoder().encode(
      changed
        .slice(0, -1)
        .padEnd(end - 11)
        .slice(0, end - 11) + '\n',
    ),
    ...body,
  ]);
}
