/**
 * `npm run bench`: how long a dance takes, stage by stage, in this machine's browser, against onnxruntime native and
 * PyTorch eager in the same run, and what a visitor waits for in the built app. Prints tables, writes bench.json and
 * docs/lengths.svg.
 *
 *     npm run bench -- --frames 2066 --threads 1,2 --repeats 5 --minutes 1,2.5,5,10 --only app
 *
 * With `--gpu` the browser uses the graphics card, for the stage and for rows of WebGPU, and docs/lengths.svg stays.
 */
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';
import { installPythonPackages } from '../install.mjs';
import { runOrThrow, python, root, runMain } from '../run.mjs';
import { appTables, measureApp } from './app/measure.mjs';
import { launchBrowser, measureBackends } from './browser.mjs';
import { servePage } from './built-page.mjs';
import { STAGES, table, withRatios } from './table.mjs';

/** @typedef {import('./table.mjs').Row} Row */

const { values: options } = parseArgs({
  options: {
    frames: { type: 'string', default: '2066' },
    threads: { type: 'string', default: '1,2' },
    repeats: { type: 'string', default: '5' },
    model: { type: 'string', default: 'web/public/models/salsa' },
    checkpoint: { type: 'string', default: 'training/checkpoints/salsa' },
    minutes: { type: 'string', default: '1,2.5,5,10' },
    only: { type: 'string' },
    gpu: { type: 'boolean', default: false },
    out: { type: 'string', default: 'bench.json' },
  },
});

/**
 * onnxruntime native and PyTorch eager.
 *
 * @param {string} folder where the scene goes
 * @param {number} threads
 * @returns {Promise<Row[]>}
 */
async function measurePython(folder, threads) {
  const { model, checkpoint, frames, repeats } = options;
  const settings = { model, checkpoint, frames, repeats, threads: String(threads), out: folder };
  const flags = Object.entries(settings).flatMap(([name, value]) => [`--${name}`, value]);
  await runOrThrow(python, ['-m', 'export.bench', ...flags]);
  return /** @type {Row[]} */ (JSON.parse(await readFile(path.join(folder, 'python.json'), 'utf8')));
}

/**
 * The app's own modules in a real browser, one fresh page for each number of threads, and one for WebGPU.
 *
 * @param {string} folder where the scene is
 * @param {number[]} threadCounts
 * @returns {Promise<Row[]>}
 */
async function measureBrowser(folder, threadCounts) {
  const pageFolder = fileURLToPath(new URL('page', import.meta.url));
  const model = path.resolve(root, options.model);
  const page = await servePage(pageFolder, { '/scene/': folder, '/model/': model });
  const browser = await launchBrowser({ backend: options.gpu ? 'webgpu' : 'wasm', gpu: options.gpu });
  try {
    return await measureBackends(browser, page.url, { ...options, threadCounts });
  } finally {
    await browser.close();
    await page.close();
  }
}

/**
 * How many steps a sampling of the model has.
 *
 * @returns {Promise<number>}
 */
async function samplingSteps() {
  const manifest = await readFile(path.resolve(root, options.model, 'manifest.json'), 'utf8');
  return JSON.parse(manifest).diffusion.steps;
}

/**
 * The stages of a dance.
 *
 * @param {string} folder
 */
async function measureStages(folder) {
  await installPythonPackages();
  const threadCounts = options.threads.split(',').map(Number);
  const references = await measurePython(folder, Math.max(...threadCounts));
  return withRatios([...(await measureBrowser(folder, threadCounts)), ...references]);
}

await runMain(async () => {
  if (![undefined, 'stages', 'app'].includes(options.only))
    throw new Error(`--only ${options.only}: it is stages or app`);
  const folder = await mkdtemp(path.join(os.tmpdir(), 'reactdance-bench-'));
  try {
    /** @param {'stages' | 'app'} part */
    const wanted = (part) => (options.only ?? part) === part;
    const frames = Number(options.frames);
    const rows = wanted('stages') ? await measureStages(folder) : [];
    const app = wanted('app')
      ? await measureApp(folder, {
          frames,
          minutes: options.minutes.split(',').map(Number),
          gpu: options.gpu,
        })
      : null;
    const [processor] = os.cpus();
    const { stdout: commit } = await promisify(execFile)('git', ['rev-parse', '--short', 'HEAD'], {
      cwd: root,
    });
    const report = {
      machine: {
        processor: processor?.model.trim() ?? 'unknown',
        cores: os.availableParallelism(),
        memory: Math.round(os.totalmem() / 2 ** 30),
        system: `${os.type()} ${os.release()}`,
        load: os.loadavg()[0],
      },
      commit: commit.trim(),
      model: options.model,
      frames,
      steps: await samplingSteps(),
      stages: STAGES,
      rows,
      app,
    };
    await writeFile(path.resolve(root, options.out), `${JSON.stringify(report, null, 2)}\n`);
    console.log(`\n${frames} frames, steps: ${report.steps}, seconds (${report.machine.processor}):`);
    if (rows.length > 0) console.log(`\n${table(rows)}`);
    if (app) console.log(`\n${appTables(app)}`);
    console.log(`\nWritten to ${options.out}.`);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
});
