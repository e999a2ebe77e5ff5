/** `npm run check`: formatting, lint and types of both languages. */
import { installNodePackages, installPythonPackages } from './install.mjs';
import { isProgram, runOrThrow, python, runMain, step } from './run.mjs';

/** Checks formatting, then lint and types side by side. @throws when one of them fails */
export async function check() {
  await step('format', async () => {
    await runOrThrow('prettier', ['--check', '--log-level', 'warn', '.']);
    await runOrThrow(python, ['-m', 'ruff', 'format', '--check', '--quiet']);
  });
  // Each of them keeps one core busy.
  const ended = await Promise.allSettled([
    step('lint', async () => {
      await runOrThrow('eslint', ['.']);
      await runOrThrow(python, ['-m', 'ruff', 'check', '--quiet']);
    }),
    step('types', async () => {
      await runOrThrow('tsc', ['-p', 'web']);
      await runOrThrow('tsc', ['-p', '.']);
      await runOrThrow(python, ['-m', 'pyright']);
    }),
  ]);
  for (const one of ended) if (one.status === 'rejected') throw one.reason;
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
