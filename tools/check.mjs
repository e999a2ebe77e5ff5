/** `npm run check`: formatting, lint and types of both languages. */
import { pathToFileURL } from 'node:url';
import { installNodePackages, installPythonPackages } from './install.mjs';
import { must, python, runMain, step } from './run.mjs';

/** Each ends the program when it finds a fault. */
export async function check() {
  await step('format', async () => {
    await must('prettier', ['--check', '--log-level', 'warn', '.']);
    await must(python, ['-m', 'ruff', 'format', '--check', '--quiet']);
  });
  await step('lint', async () => {
    await must('eslint', ['.']);
    await must(python, ['-m', 'ruff', 'check', '--quiet']);
  });
  await step('types', async () => {
    await must('tsc', ['-p', 'web']);
    await must('tsc', ['-p', '.']);
    await must(python, ['-m', 'pyright']);
  });
}

/** What both `npm run check` and `npm test` need first. */
export async function installPackages() {
  await step('node packages', installNodePackages);
  await step('python packages', installPythonPackages);
}

if (process.argv[1] !== undefined && import.meta.url === pathToFileURL(process.argv[1]).href) {
  await runMain(async () => {
    await installPackages();
    await check();
  });
}
