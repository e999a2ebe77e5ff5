import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { metadataOf, type Dance } from './dance';

/** Positions are rounded to a tenth of a millimetre. */
const STEPS_PER_METRE = 1e4;

function point(values: Float32Array, joint: number): string {
  const at = (axis: number): number =>
    Math.round((values[joint * 3 + axis] ?? 0) * STEPS_PER_METRE) / STEPS_PER_METRE;
  return `[${at(0)},${at(1)},${at(2)}]`;
}

/** One frame a line. */
function frameLines({ positions, frames }: SolvedMotion): string {
  const frame = (index: number): string => {
    const joints = Array.from({ length: JOINT_COUNT }, (_, j) => point(positions, index * JOINT_COUNT + j));
    return `   [${joints.join(',')}]`;
  };
  return Array.from({ length: frames }, (_, index) => frame(index)).join(',\n');
}

/**
 * Joint positions as JSON: format, units, joint names and all settings first, then
 * `positions` with, by dancer, one line for every frame of 22 points [x, y, z] in metres.
 */
export function writeJson(dance: Dance): string {
  const head = JSON.stringify(metadataOf(dance), null, 1).replace(/\n}$/, '');
  const dancers = dance.dancers.map(({ role, motion }) => `  "${role}": [\n${frameLines(motion)}\n  ]`);
  return `${head},\n "positions": {\n${dancers.join(',\n')}\n }\n}\n`;
}
