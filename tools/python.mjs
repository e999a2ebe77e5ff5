/** Runs the project's Python, installed first if need be: `node tools/python.mjs -m pytest`. */
import { installPythonPackages } from './install.mjs';
import { python, run, runMain } from './run.mjs';

await runMain(async () => {
  await installPythonPackages();
  process.exitCode = await run(python, process.argv.slice(2));
});
