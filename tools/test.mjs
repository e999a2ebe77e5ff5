/** `npm test`: everything that has to hold, from a fresh clone on. The first failure stops it. */
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { check, installPackages } from './check.mjs';
import { installBrowser } from './install.mjs';
import { must, python, runMain, step } from './run.mjs';

/** @typedef {{ passed: number, failed: number, skipped: number }} Count */

/** @param {string} report vitest's JSON @returns {Count} */
function countVitest(report) {
  const result = JSON.parse(report);
  // A file that can't be loaded has no tests to fail.
  const failed = Math.max(result.numFailedTests, result.success ? 0 : 1);
  return { passed: result.numPassedTests, failed, skipped: result.numPendingTests + result.numTodoTests };
}

/** @param {string} report pytest's JUnit XML @returns {Count} */
function countPytest(report) {
  const suite = /<testsuite [^>]*>/.exec(report)?.[0] ?? '';
  /** @param {string} name */
  const number = (name) => Number(new RegExp(`\\b${name}="(\\d+)"`).exec(suite)?.[1] ?? 0);
  const failed = number('failures') + number('errors');
  return { passed: number('tests') - failed - number('skipped'), failed, skipped: number('skipped') };
}

/** @param {string} report Playwright's JSON @returns {Count} */
function countPlaywright(report) {
  const { stats, errors } = JSON.parse(report);
  return {
    passed: stats.expected + stats.flaky,
    failed: stats.unexpected + errors.length,
    skipped: stats.skipped,
  };
}

/** @type {Count[]} */
const counts = [];

/**
 * A step whose runner writes a report of its tests.
 *
 * @param {string} name
 * @param {(report: string) => Count} count
 * @param {(reportFile: string) => Promise<void>} work
 */
async function testStep(name, count, work) {
  const folder = await mkdtemp(path.join(tmpdir(), 'reactdance-test-'));
  const reportFile = path.join(folder, 'report');
  try {
    await step(name, () => work(reportFile));
  } finally {
    const report = await readFile(reportFile, 'utf8').catch(() => undefined);
    counts.push(report === undefined ? { passed: 0, failed: 1, skipped: 0 } : count(report));
    await rm(folder, { recursive: true });
  }
}

await runMain(async () => {
  await installPackages();
  await step('browser', installBrowser);
  await check();
  await testStep('vitest', countVitest, (report) =>
    must('vitest', ['run', '--reporter=default', '--reporter=json', `--outputFile.json=${report}`]),
  );
  await testStep('pytest', countPytest, (report) => must(python, ['-m', 'pytest', `--junitxml=${report}`]));
  await step('build', () => must('vite', ['build', '--logLevel', 'warn']));
  await testStep('browser tests', countPlaywright, (report) =>
    must('playwright', ['test', '--reporter=list,json'], { PLAYWRIGHT_JSON_OUTPUT_NAME: report }),
  );
});

/** @param {keyof Count} outcome */
const total = (outcome) => counts.reduce((sum, count) => sum + count[outcome], 0);
// A fault before the tests (format, types, build) is a failure too, though no test has seen it.
const failed = process.exitCode === undefined ? 0 : Math.max(1, total('failed'));
console.log(`\n${total('passed')} passed, ${failed} failed, ${total('skipped')} skipped`);
