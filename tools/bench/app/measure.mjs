/** Figures of the whole app as a visitor meets it. */
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { root, runOrThrow } from '../../run.mjs';
import { plot } from '../plot.mjs';
import { measureColdStart } from './cold-start.mjs';
import { measureLength } from './lengths.mjs';
import { measureSlider } from './slider.mjs';

/** @typedef {Awaited<ReturnType<typeof measureApp>>} AppFigures */

/**
 * @param {string} folder for files that are not kept
 * @param {{ frames: number, minutes: number[], gpu: boolean }} options frames of the dance whose fader is moved; lengths
 *   to compare; whether the browser has a graphics card, on which the model is then measured too
 */
export async function measureApp(folder, { frames, minutes, gpu }) {
  await runOrThrow('vite', ['build', '--logLevel', 'warn']);
  /** @type {import('../browser.mjs').Where['backend'][]} */
  const backends = gpu ? ['wasm', 'webgpu'] : ['wasm'];
  const waits = [];
  for (const backend of backends) {
    const where = { backend, gpu };
    waits.push({
      backend,
      coldStart: await measureColdStart(where),
      slider: await measureSlider(folder, frames, where),
    });
  }
  const lengths = [];
  for (const each of minutes)
    lengths.push(await measureLength(folder, each, { backend: gpu ? 'webgpu' : 'wasm', gpu }));
  if (!gpu) await writeFile(path.join(root, 'docs/lengths.svg'), plotLengths(lengths));
  return { waits, lengths };
}

/** @param {AppFigures} figures @returns {string} tables in Markdown */
export function appTables({ waits, lengths }) {
  /** @param {(each: AppFigures['waits'][number]) => string} valueOf */
  const row = (valueOf) => waits.map(valueOf).join(' | ');
  return [
    `| | ${row(({ backend }) => (backend === 'webgpu' ? 'WebGPU' : 'processor'))} |`,
    `|---|${row(() => '---:').replaceAll(' ', '')}|`,
    `| cold start until the model is ready | ${row(({ coldStart }) => `${coldStart.ready.toFixed(1)} s`)} |`,
    `| cold start until the first generated dance | ${row(({ coldStart }) => `${coldStart.generated.toFixed(1)} s`)} |`,
    `| sent by the server until then | ${row(({ coldStart }) => `${coldStart.megabytes.toFixed(1)} MB`)} |`,
    `| a moved fader until new frames are drawn, while it plays | ${row(({ slider }) => `${slider.first.toFixed(0)} ms`)} |`,
    `| until the whole new dance is drawn | ${row(({ slider }) => `${slider.whole.toFixed(0)} ms`)} |`,
    `| one rendered frame meanwhile | ${row(({ slider }) => `${slider.picture.toFixed(0)} ms`)} |`,
    '',
    '| minutes | song read, s | leader read, s | dance made, s | most memory, MB | longest task, ms |',
    '|---:|---:|---:|---:|---:|---:|',
    ...lengths.map(
      ({ minutes, song, leader, dance, memory, longestTask }) =>
        `| ${[minutes, song.toFixed(1), leader.toFixed(1), dance.toFixed(1), memory.toFixed(0), longestTask.toFixed(0)].join(' | ')} |`,
    ),
  ].join('\n');
}

/**
 * Time and memory over the length of a dance.
 *
 * @param {readonly import('./lengths.mjs').Length[]} lengths ascending
 */
function plotLengths(lengths) {
  const ticks = lengths.map(({ minutes }) => ({ at: minutes, text: `${minutes} min` }));
  /** @param {string} title @param {(length: import('./lengths.mjs').Length) => number} valueOf */
  const panel = (title, valueOf) => ({
    title,
    ticks,
    lines: [{ points: lengths.map((length) => /** @type {const} */ ([length.minutes, valueOf(length)])) }],
  });
  return plot([
    panel('seconds until the dance is ready', ({ song, leader, dance }) => song + leader + dance),
    panel('most memory of the page’s processes, MB', ({ memory }) => memory),
  ]);
}
