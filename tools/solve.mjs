/**
 * Solves joint positions as the page does, so that other programs can measure what is drawn and exported.
 *
 *     node tools/solve.mjs [--foot-lock] positions.f32 solved.f32
 *
 * Both files are raw little-endian float32, frames x 22 x 3, metres, 30 fps. Prints the fit error in millimetres.
 * With --foot-lock planted feet are kept from sliding, as by the page's setting of that name.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { loadWeb } from './load-web.mjs';

const { values, positionals } = parseArgs({
  options: { 'foot-lock': { type: 'boolean', default: false } },
  allowPositionals: true,
});
const [from, to] = positionals;
if (from === undefined || to === undefined) {
  console.error('Usage: node tools/solve.mjs [--foot-lock] positions.f32 solved.f32');
  process.exit(2);
}
const bytes = new Uint8Array(readFileSync(from));
if (bytes.length === 0 || bytes.length % (22 * 3 * 4) !== 0) {
  console.error(`${from} holds ${bytes.length} bytes, which are no whole frames of 22 joints.`);
  process.exit(2);
}
const positions = new Float32Array(bytes.buffer);

/** @type {typeof import('../web/motion/solve')} */
const { solve } = await loadWeb('motion/solve.ts');
/** @type {typeof import('../web/motion/foot-lock')} */
const { lockFeet } = await loadWeb('motion/foot-lock.ts');
const solved = solve({ fps: 30, frames: positions.length / 66, positions });
const motion = values['foot-lock'] ? lockFeet(solved) : solved;
writeFileSync(to, new Uint8Array(motion.positions.buffer));
console.log(`${motion.frames} frames, fit error ${(motion.fitError * 1000).toFixed(2)} mm`);
