import { spawn } from 'node:child_process';
import { existsSync, realpathSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

/** The folder of the project. */
export const root = fileURLToPath(new URL('..', import.meta.url));

const windows = process.platform === 'win32';

/**
 * Windows starts npm's programs through a shell, which would cut a path at its spaces.
 *
 * @param {string} program
 */
const needsShell = (program) => windows && !path.isAbsolute(program);

/** Path of the Python interpreter in the project's virtual environment. */
export const python = path.join(root, '.venv', windows ? 'Scripts/python.exe' : 'bin/python');

/**
 * Runs a program in the project's folder, its output shown as it comes. Programs of node_modules are found.
 *
 * @param {string} program
 * @param {string[]} args
 * @param {Record<string, string>} [env] further environment variables
 * @returns {Promise<number>} its exit code; 127 when it can't be started
 */
export function run(program, args, env = {}) {
  const search = [path.join(root, 'node_modules', '.bin'), process.env['PATH'] ?? ''].join(path.delimiter);
  return new Promise((resolve) => {
    const child = spawn(program, args, {
      cwd: root,
      stdio: ['ignore', 'inherit', 'inherit'],
      env: { ...process.env, ...env, PATH: search },
      shell: needsShell(program),
    });
    child.on('error', () => resolve(127));
    child.on('close', (code) => resolve(code ?? 1));
  });
}

/**
 * Runs a program and throws when it fails.
 *
 * @param {string} program
 * @param {string[]} args
 * @param {Record<string, string>} [env]
 */
export async function runOrThrow(program, args, env) {
  const code = await run(program, args, env);
  if (code !== 0) throw new Error(`${[program, ...args].join(' ')} ended with ${code}`);
}

/**
 * Runs a program without showing what it prints.
 *
 * @param {string} program
 * @param {string[]} args
 * @returns {Promise<string | undefined>} what it printed, or undefined when it failed or isn't there
 */
export function outputOf(program, args) {
  return new Promise((resolve) => {
    let output = '';
    // None of these programs is a script of npm, which Windows would start through a shell.
    const child = spawn(program, args, {
      cwd: root,
      stdio: ['ignore', 'pipe', 'ignore'],
    });
    child.stdout.on('data', (chunk) => (output += String(chunk)));
    child.on('error', () => resolve(undefined));
    child.on('close', (code) => resolve(code === 0 ? output.trim() : undefined));
  });
}

/**
 * Does a piece of work, printing its name before and its seconds after.
 *
 * @param {string} name
 * @param {() => Promise<void>} work
 * @throws {StepFailed} when the work throws, once its error is printed
 */
export async function step(name, work) {
  console.log(`\n== ${name}`);
  const start = performance.now();
  try {
    await work();
  } catch (error) {
    console.error(
      `== ${name}: failed after ${seconds(start)} s: ${error instanceof Error ? error.message : error}`,
    );
    throw new StepFailed(name);
  }
  console.log(`== ${name}: ${seconds(start)} s`);
}

/** A step has failed, and its error is already printed. */
export class StepFailed extends Error {}

/** @param {number} start */
function seconds(start) {
  return ((performance.now() - start) / 1000).toFixed(1);
}

/**
 * Whether a module is the program that was started, not one that a program imports.
 *
 * @param {string} url the module's import.meta.url, in which Node has followed links, as it has not in what was started
 */
export function isProgram(url) {
  const [, started] = process.argv;
  return started !== undefined && existsSync(started) && url === pathToFileURL(realpathSync(started)).href;
}

/**
 * Runs a program's main function: a failed step or an error ends it with exit code 1.
 *
 * @param {() => Promise<void>} main
 */
export async function runMain(main) {
  try {
    await main();
  } catch (error) {
    if (!(error instanceof StepFailed)) console.error(error instanceof Error ? error.message : error);
    process.exitCode = 1;
  }
}
