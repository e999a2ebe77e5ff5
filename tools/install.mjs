/** Installs what building and testing need. Imports built-in modules only: it runs before anything is installed. */
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { findBrowser } from './browser.mjs';
import { outputOf, python, root, run, runOrThrow } from './run.mjs';

/** The minor versions of Python 3 that the pinned packages are built for: the oldest and the newest. */
const PYTHON_MINORS = /** @type {const} */ ([11, 14]);

/**
 * Whether the pinned packages run on a version of Node. On others npm leaves out programs that the build needs.
 *
 * @param {string} version
 */
export function nodeIsSupported(version) {
  const [major = 0, minor = 0] = version.split('.').map(Number);
  return major >= 24 || (major === 22 && minor >= 13) || (major === 20 && minor >= 19);
}

/** Installs the pinned node packages unless exactly these are there. */
export async function installNodePackages() {
  const { node } = process.versions;
  if (!nodeIsSupported(node)) {
    throw new Error(`Node 24 or newer is needed, or 22 from 22.13, or 20 from 20.19; this is ${node}`);
  }
  if (!nodePackagesMatch()) await runOrThrow('npm', ['ci']);
}

/** npm leaves a copy of the lock file of what it has installed: compare the versions. */
function nodePackagesMatch() {
  const installedLock = path.join(root, 'node_modules', '.package-lock.json');
  if (!existsSync(installedLock)) return false;
  const wanted = packagesOf(path.join(root, 'package-lock.json'));
  const installed = packagesOf(installedLock);
  return Object.entries(wanted).every(
    ([name, { version, optional }]) =>
      name === '' || installed[name]?.version === version || (optional && installed[name] === undefined),
  );
}

/**
 * @param {string} lockFile
 * @returns {Record<string, { version?: string, optional?: boolean }>}
 */
function packagesOf(lockFile) {
  return JSON.parse(readFileSync(lockFile, 'utf8')).packages;
}

/** Makes .venv with the pinned Python packages unless it was made from these very pins. */
export async function installPythonPackages() {
  const pins = path.join(root, 'constraints.txt');
  const stamp = path.join(root, '.venv', 'constraints.sha256');
  const hash = createHash('sha256').update(readFileSync(pins)).digest('hex');
  if (existsSync(python) && existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) return;

  console.log('PyTorch comes with its CUDA libraries, about 2.7 GB: this takes minutes, once.');
  const uv = (await outputOf('uv', ['--version'])) !== undefined;
  // One whose Python is gone, is too old or has no pip can't be repaired.
  const usable =
    (await supportedPython(python)) !== undefined &&
    (uv || (await outputOf(python, ['-m', 'pip', '--version'])) !== undefined);
  if (!usable) {
    const interpreter = await findPython();
    if (uv) await runOrThrow('uv', ['venv', '--clear', '--python', interpreter, '.venv']);
    else await runOrThrow(interpreter, ['-m', 'venv', '--clear', '.venv']);
  }
  if (uv) await runOrThrow('uv', ['pip', 'sync', '--python', python, pins]);
  else await runOrThrow(python, ['-m', 'pip', 'install', '--no-deps', '-r', pins]);
  // Two processes that compile librosa's numba functions at once leave a cache that crashes each later one
  // (https://github.com/numba/numba/issues/10128), so one process compiles them all. Imports by name have one
  // order; EAGER_IMPORT goes through a set, and one order in thirty ends in a circular import.
  const imports = ['librosa', 'librosa.feature', 'librosa.util'].map((name) => `from ${name} import *`);
  await runOrThrow(python, ['-c', imports.join('; ')]);
  writeFileSync(stamp, hash);
}

/**
 * The path of a Python that the pinned packages are built for.
 *
 * @throws when there is none
 */
async function findPython() {
  const [oldest, newest] = PYTHON_MINORS;
  const named = Array.from({ length: newest - oldest + 1 }, (_, older) => `python3.${newest - older}`);
  for (const name of ['python3', ...named, 'python']) {
    const executable = await supportedPython(name);
    if (executable !== undefined) return executable;
  }
  throw new Error(
    `Python 3.${oldest} to 3.${newest} is needed and none was found: install one of them, with venv`,
  );
}

/**
 * @param {string} name of an interpreter, or its path
 * @returns {Promise<string | undefined>} its path, or undefined when it isn't there or its version isn't supported
 */
async function supportedPython(name) {
  const script = 'import sys; print(*sys.version_info[:2], sys.executable, sep="\\n")';
  const [major, minor, executable] = (await outputOf(name, ['-c', script]))?.split(/\r?\n/) ?? [];
  const [oldest, newest] = PYTHON_MINORS;
  return Number(major) === 3 && Number(minor) >= oldest && Number(minor) <= newest ? executable : undefined;
}

/** Finds a Chromium for the browser tests, or installs one. */
export async function installBrowser() {
  if ((await findBrowser()) !== undefined) return;
  const isDebianRoot = process.getuid?.() === 0 && (await outputOf('apt-get', ['--version'])) !== undefined;
  if (isDebianRoot) {
    await runOrThrow('apt-get', ['-o', 'Acquire::Retries=3', 'update']);
    await runOrThrow('apt-get', ['-o', 'Acquire::Retries=3', 'install', '-y', 'chromium'], {
      DEBIAN_FRONTEND: 'noninteractive',
    });
  } else {
    await run('playwright', ['install', 'chromium']);
  }
  if ((await findBrowser()) === undefined) {
    throw new Error('No Chromium was found: install chromium or Chrome, or set CHROMIUM to its path');
  }
}
