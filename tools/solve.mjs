/**
 * Solves joint positions as the page does, so that other programs can measure what is drawn and exported.
 *
 *     node tools/solve.mjs [--beside leader.f32 --manifest manifest.json [--song song.f32]] [--foot-lock] motion.f32 ...
 *     node tools/solve.mjs --body body.f32 motion.f32 ...
 *
 * The .f32 files are raw little-endian float32, frames x 22 x 3, metres, 30 fps; each motion is replaced by its solved
 * form, and its fit error printed in millimetres. With --beside the dancer keeps to what the page lets a partner do
 * (web/motion/contact/beside-partner.ts), to the beats of the song where there is one: song.f32 holds its features, frames x
 * 54. Of manifest.json only `quality` and `audio` are read. With --foot-lock feet in contact do not slide, as with the page's
 * setting of that name. With --body the dance is written in another body, as the page gives a leader to the model: body.f32
 * holds rest offsets, 22 x 3, metres, and the dance is scaled to their height.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { loadWeb } from './load-web.mjs';

const { values, positionals } = parseArgs({
  options: {
    beside: { type: 'string' },
    manifest: { type: 'string' },
    song: { type: 'string' },
    'foot-lock': { type: 'boolean', default: false },
    body: { type: 'string' },
  },
  allowPositionals: true,
});
if (
  positionals.length === 0 ||
  (values.beside === undefined) !== (values.manifest === undefined) ||
  (values.song !== undefined && values.beside === undefined) ||
  (values.body !== undefined && (values.beside !== undefined || values['foot-lock']))
) {
  console.error(
    'Usage: node tools/solve.mjs [--beside leader.f32 --manifest manifest.json [--song song.f32]] [--foot-lock] motion.f32 ...\n' +
      '       node tools/solve.mjs --body body.f32 motion.f32 ...',
  );
  process.exit(2);
}

/** @param {string} file */
function read(file) {
  const bytes = new Uint8Array(readFileSync(file));
  if (bytes.length === 0 || bytes.length % (22 * 3 * 4) !== 0) {
    console.error(`${file} holds ${bytes.length} bytes, which are no whole frames of 22 joints.`);
    process.exit(2);
  }
  const positions = new Float32Array(bytes.buffer);
  return { fps: 30, frames: positions.length / 66, positions };
}

/** @type {typeof import('../web/motion/fit/ik')} */
const { solve } = await loadWeb('motion/fit/ik.ts');
/** @type {typeof import('../web/motion/contact/beside-partner')} */
const { besidePartner } = await loadWeb('motion/contact/beside-partner.ts');
/** @type {typeof import('../web/motion/skeleton/kinematics')} */
const { inBody, restPositions } = await loadWeb('motion/skeleton/kinematics.ts');
/** @type {typeof import('../web/motion/skeleton/scale')} */
const { bodyHeight } = await loadWeb('motion/skeleton/scale.ts');
/** @type {typeof import('../web/audio/rhythm/rhythm')} */
const { rhythmOf } = await loadWeb('audio/rhythm/rhythm.ts');
/** @type {typeof import('../web/motion/beats/step-timing')} */
const { stepCounts } = await loadWeb('motion/beats/step-timing.ts');
/** @type {typeof import('../web/motion/contact/foot-lock')} */
const { withFootLock } = await loadWeb('motion/contact/foot-lock.ts');
const leader = values.beside === undefined ? null : read(values.beside);
const manifest = values.manifest === undefined ? null : JSON.parse(readFileSync(values.manifest, 'utf8'));
const song =
  values.song === undefined ? null : new Float32Array(new Uint8Array(readFileSync(values.song)).buffer);
const beats = song === null ? [] : rhythmOf(song, manifest.audio).beats;
const body = values.body === undefined ? null : read(values.body).positions;
const height = body && bodyHeight({ fps: 30, frames: 1, positions: restPositions(body) });
for (const file of positionals) {
  const clip = read(file);
  let motion = solve(clip);
  if (body !== null && height !== null) {
    const positions = inBody(clip, motion, body, height / bodyHeight(clip));
    writeFileSync(file, new Uint8Array(positions.buffer));
    console.log(`${file}: ${motion.frames} frames in another body`);
    continue;
  }
  if (leader !== null) {
    if (leader.frames !== clip.frames) {
      console.error(`${values.beside} has ${leader.frames} frames, ${file} has ${clip.frames}.`);
      process.exit(2);
    }
    const beatFrames = beats.map((seconds) => seconds * clip.fps);
    motion = besidePartner(motion, leader, manifest.quality, stepCounts(beatFrames, clip.frames, clip.fps));
  }
  if (values['foot-lock']) motion = withFootLock(motion);
  writeFileSync(file, new Uint8Array(motion.positions.buffer));
  console.log(`${file}: ${motion.frames} frames, fit error ${(motion.fitError * 1000).toFixed(2)} mm`);
}
