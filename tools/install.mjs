/** Brings a fresh machine to where the project can be built and tested. Only built-in modules. */
import { createHash } from 'node:crypto';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { findBrowser } from './browser.mjs';
import { ask, must, python, root, run } from './run.mjs';

const NODE = /** @type {const} */ ([20, 19]);
const PYTHON = /** @type {const} */ ([3, 11]);

/** Installs the pinned node packages unless exactly these are there. */
export async function installNodePackages() {
  const [major = 0, minor = 0] = process.versions.node.split('.').map(Number);
  if (major < NODE[0] || (major === NODE[0] && minor < NODE[1])) {
    throw new Error(`Node ${NODE.join('.')} or newer is needed; this is ${process.versions.node}`);
  }
  if (!nodePackagesMatch()) await must('npm', ['ci']);
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
  const uv = (await ask('uv', ['--version'])) !== undefined;
  if (!existsSync(python)) {
    const interpreter = await findPython();
    if (uv) await must('uv', ['venv', '--python', interpreter, '.venv']);
    else await must(interpreter, ['-m', 'venv', '.venv']);
  }
  if (uv) await must('uv', ['pip', 'sync', '--python', python, pins]);
  else await must(python, ['-m', 'pip', 'install', '--no-deps', '-r', pins]);
  writeFileSync(stamp, hash);
}

/** The path of a Python that is new enough. */
async function findPython() {
  const tell = 'import sys; print(*sys.version_info[:2], sys.executable, sep="\\n")';
  for (const name of ['python3', 'python3.13', 'python3.12', 'python3.11', 'python']) {
    const [major, minor, executable] = (await ask(name, ['-c', tell]))?.split(/\r?\n/) ?? [];
    if (executable && Number(major) === PYTHON[0] && Number(minor) >= PYTHON[1]) return executable;
  }
  throw new Error(
    `Python ${PYTHON.join('.')} or newer is needed and none was found: install python3 with venv`,
  );
}

/** Finds a Chromium for the browser tests, or installs one. */
export async function installBrowser() {
  if ((await findBrowser()) !== undefined) return;
  const debianRoot = process.getuid?.() === 0 && (await ask('apt-get', ['--version'])) !== undefined;
  if (debianRoot) {
    await must('apt-get', ['update']);
    await must('apt-get', ['install', '-y', 'chromium'], { DEBIAN_FRONTEND: 'noninteractive' });
  } else {
    await run('playwright', ['install', 'chromium']);
  }
  if ((await findBrowser()) === undefined) {
    throw new Error('No Chromium was found: install chromium or Chrome, or set CHROMIUM to its path');
  }
}
