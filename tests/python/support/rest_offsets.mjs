/**
 * Prints the rest offsets that the page finds for a motion, as JSON.
 *
 *     node tests/python/support/rest_offsets.mjs motion.f32
 */
import { readFileSync } from 'node:fs';
import { loadWeb } from '../../../tools/load-web.mjs';

/** @type {typeof import('../../../web/motion/fit/rest-pose')} */
const { restOffsets } = await loadWeb('motion/fit/rest-pose.ts');
/** @type {typeof import('../../../web/motion/fit/trunk')} */
const { trunkRotations } = await loadWeb('motion/fit/trunk.ts');

const bytes = new Uint8Array(readFileSync(process.argv[2] ?? ''));
const observed = new Float64Array(new Float32Array(bytes.buffer));
console.log(JSON.stringify([...restOffsets(observed, trunkRotations(observed))]));
