import { readFileSync } from 'node:fs';
import { zipSync, unzipSync } from 'fflate';
import { expect, test } from 'vitest';
import { readGolden } from '../../../web/model/load/golden';
import { openSession } from '../../../web/model/load/session';
import { type Manifest, parseManifest } from '../../../web/model/manifest';
import { Pipeline } from '../../../web/model/sample/pipeline';
import { secondsNow } from '../../../web/model/sample/playhead';
import { ddim } from '../../../web/model/sample/schedule';
import { checkPlausible } from '../../../web/motion/skeleton/plausible';
import { fuzz } from '../support/hostile/fuzz';
import { damagedBytes, damagedJson, randomOf } from '../support/hostile/mutations';
import { madeDancer } from '../support/made-dancer';
import { readModel, TINY } from '../support/open-model';
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
      for (const step of ddim(diffusion, diffusion.steps.default))
        expect(Object.values(step).every(Number.isFinite)).toBe(true);
    },
  );
  expect(refused).toBeGreaterThan(0);
});

/** How many of the damaged manifests that are accepted are danced with: opening the graphs takes a while. */
const DANCED = 12;

test('a damaged manifest that is accepted can be danced with', { timeout: 600_000 }, async () => {
  const { manifest: sound, graphs } = readModel(TINY);
  const leader = madeDancer({ frames: 60 });
  const failures: string[] = [];
  let danced = 0;
  for (let seed = 0; danced < DANCED; seed++) {
    let manifest: Manifest;
    try {
      manifest = parseManifest(damagedJson(sound, randomOf(seed)));
    } catch {
      continue;
    }
    const { guidance, diffusion, latent } = manifest;
    // Thousands of steps are possible, and only take long.
    if (JSON.stringify(manifest) === JSON.stringify(sound) || diffusion.steps.default > 50) continue;
    danced++;
    const session = await openSession(manifest, graphs, 'wasm', 1);
    try {
      const dance = await new Pipeline(manifest, session, secondsNow).generate({
        leader,
        music: null,
        guidance: new Float32Array(latent.streams.length * latent.layers.length).fill(guidance.coarse.max),
        musicGuidance: guidance.music.default,
        variety: guidance.variety.default,
        steps: diffusion.steps.default,
        seed: 1,
      });
      expect(dance.motion.frames).toBe(60);
      checkPlausible(dance.motion);
    } catch (error) {
      failures.push(`case ${seed}: ${String(error)}`);
    } finally {
      await session.release();
    }
  }
  expect(failures).toEqual([]);
});

test('a damaged golden sampling is refused in a sentence or whole and finite', { timeout: 600_000 }, () => {
  const path = new URL('../../fixtures/tiny-model/golden.npz', import.meta.url);
  const read = unzipSync(readFileSync(path));
  const names = [
    'leader',
    'music',
    'music_valid',
    'role',
    'coarse',
    'fine',
    'music_guidance',
    'seed',
    'steps',
  ];
  const files = Object.fromEntries(
    [...names, 'bones', 'reactor'].map((name) => [`${name}.npy`, short(read[`${name}.npy`]!)]),
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
      for (const values of [golden.leader, golden.music, golden.bones, golden.guidance, golden.reactor])
        expect(values.every((value) => Number.isFinite(value))).toBe(true);
      expect(golden.steps).toBeGreaterThan(0);
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
