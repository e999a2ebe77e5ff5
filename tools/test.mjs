/** `npm test`: everything that has to hold, from a fresh clone on. The first failure stops it. */
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { check, installPackages } from './check.mjs';
import { installBrowser } from './install.mjs';
import { runOrThrow, python, runMain, step } from './run.mjs';
import { noReport, readPlaywright, readPytest, readVitest, summary } from './test-reports.mjs';

/** @typedef {import('./test-reports.mjs').Report} Report */

/** @type {Report[]} */
const reports = [];

/**
 * A step whose runner writes a report of its tests.
 *
 * @param {string} name
 * @param {(report: string) => Report} read
 * @param {(reportFile: string) => Promise<void>} work
 */
async function testStep(name, read, work) {
  const folder = await mkdtemp(path.join(tmpdir(), 'reactdance-test-'));
  const reportFile = path.join(folder, 'report');
  try {
    await step(name, () => work(reportFile));
  } finally {
    const report = await readFile(reportFile, 'utf8').catch(() => undefined);
    reports.push(report === undefined ? noReport : read(report));
    await rm(folder, { recursive: true });
  }
}

/**
 * @param {string} name
 * @param {string[]} choice which tests, and how many at a time
 */
async function browserTests(name, choice) {
  await testStep(name, readPlaywright, (report) =>
    runOrThrow('playwright', ['test', ...choice, '--reporter=list,json'], {
      PLAYWRIGHT_JSON_OUTPUT_NAME: report,
    }),
  );
}

await runMain(async () => {
  await installPackages();
  await step('browser', installBrowser);
  await check();
  await testStep('vitest', readVitest, (report) =>
    runOrThrow('vitest', ['run', '--reporter=default', '--reporter=json', `--outputFile.json=${report}`]),
  );
  await testStep('pytest', readPytest, (report) =>
    // Two processes of one thread each use two cores better than one process of two threads.
    runOrThrow(python, ['-m', 'pytest', '-n', '2', '--dist', 'worksteal', `--junitxml=${report}`], {
      OMP_NUM_THREADS: '1',
    }),
  );
  await step('build', () => runOrThrow('vite', ['build', '--logLevel', 'warn']));
  await browserTests('browser tests', ['--grep-invert', '@alone']);
  await browserTests('browser tests that measure time', ['--grep', '@alone', '--workers', '1']);
});

console.log(`\n${summary(reports, process.exitCode === undefined)}`);
