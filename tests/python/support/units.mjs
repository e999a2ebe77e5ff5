/**
 * Prints the metres per unit that the page takes for bodies of the given sizes, as JSON.
 *
 *     node tests/python/support/units.mjs 1.4 150
 */
import { loadWeb } from '../../../tools/load-web.mjs';

/** @type {typeof import('../../../web/motion/retarget/axes-and-units')} */
const { findUnit } = await loadWeb('motion/retarget/axes-and-units.ts');

console.log(JSON.stringify(process.argv.slice(2).map((size) => findUnit(Number(size), null).metres)));
