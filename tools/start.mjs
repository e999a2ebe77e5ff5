/** `npm start`: from a fresh clone to the app in the browser. Needs Node alone. */
import { installNodePackages } from './install.mjs';
import { runOrThrow, runMain, step } from './run.mjs';
import { serveApp } from './serve.mjs';

await runMain(async () => {
  await step('node packages', installNodePackages);
  await step('build', () => runOrThrow('vite', ['build', '--logLevel', 'warn']));
  await serveApp();
});
