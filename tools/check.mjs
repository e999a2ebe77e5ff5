/** `npm run check`: formatting, lint and types of both languages. */
import { installNodePackages, installPythonPackages } from './install.mjs';
import { isProgram, runOrThrow, python, runMain, step } from './run.mjs';

/** Checks formatting, lint and types. @throws at the first fault */
export async function check() {
  await step('format', async () => {
    await runOrThrow('prettier', ['--check', '--log-level', 'warn', '.']);
    await runOrThrow(python, ['-m', 'ruff', 'format', '--check', '--quiet']);
  });
  await step('lint', async () => {
    await runOrThrow('eslint', ['.']);
    await runOrThrow(python, ['-m', 'ruff', 'check', '--quiet']);
  });
  await step('types', async () => {
    await runOrThrow('tsc', ['-p', 'web']);
    await runOrThrow('tsc', ['-p', '.']);
    await runOrThrow(python, ['-m', 'pyright']);
  });
}

/** Installs the packages that `npm run check` and `npm test` need. */
export async function installPackages() {
  await step('node packages', installNodePackages);
  await step('python packages', installPythonPackages);
}

if (isProgram(import.meta.url)) {
  await runMain(async () => {
    await installPackages();
    await check();
  });
}
