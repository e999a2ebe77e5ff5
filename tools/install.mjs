/** Installs what building and testing need. Imports built-in modules only: it runs before anything is installed. */
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { findBrowser } from './browser.mjs';
import { outputOf, python, root, run, runOrThrow } from './run.mjs';

/** The oldest Python, major and minor. */
const MIN_PYTHON = /** @type {const} */ ([3, 11]);

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
  if (!existsSync(python)) {
    const interpreter = await findPython();
    if (uv) await runOrThrow('uv', ['venv', '--python', interpreter, '.venv']);
    else await runOrThrow(interpreter, ['-m', 'venv', '.venv']);
  }
  if (uv) await runOrThrow('uv', ['pip', 'sync', '--python', python, pins]);
  else await runOrThrow(python, ['-m', 'pip', 'install', '--no-deps', '-r', pins]);
  // Two processes that compile librosa's numba functions at once leave a cache that crashes each later one
  // (https://github.com/numba/numba/issues/10128), so one process compiles them all.
  await runOrThrow(python, ['-c', 'import librosa'], { EAGER_IMPORT: '1' });
  writeFileSync(stamp, hash);
}

/** The path of a Python that is new enough. */
async function findPython() {
  const script = 'import sys; print(*sys.version_info[:2], sys.executable, sep="\\n")';
  for (const name of ['python3', 'python3.13', 'python3.12', 'python3.11', 'python']) {
    const [major, minor, executable] = (await outputOf(name, ['-c', script]))?.split(/\r?\n/) ?? [];
    if (executable && Number(major) === MIN_PYTHON[0] && Number(minor) >= MIN_PYTHON[1]) return executable;
  }
  throw new Error(
    `Python ${MIN_PYTHON.join('.')} or newer is needed and none was found: install python3 with venv`,
  );
}

/** Finds a Chromium for the browser tests, or installs one. */
export async function installBrowser() {
  if ((await findBrowser()) !== undefined) return;
  const isDebianRoot = process.getuid?.() === 0 && (await outputOf('apt-get', ['--version'])) !== undefined;
  if (isDebianRoot) {
    await runOrThrow('apt-get', ['update']);
    await runOrThrow('apt-get', ['install', '-y', 'chromium'], { DEBIAN_FRONTEND: 'noninteractive' });
  } else {
    await run('playwright', ['install', 'chromium']);
  }
  if ((await findBrowser()) === undefined) {
    throw new Error('No Chromium was found: install chromium or Chrome, or set CHROMIUM to its path');
  }
}
