import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { build } from 'vite';
import { licences } from '../../../tools/vite/licences.mjs';

let folder: string;

beforeEach(() => {
  folder = mkdtempSync(path.join(tmpdir(), 'reactdance-licences-'));
  write(
    'index.html',
    '<script type="module" src="/main.js"></script><link rel="stylesheet" href="/main.css">',
  );
  write('main.css', '@font-face { font-family: F; src: url("some-font/f.woff2"); }');
  write(
    'main.js',
    `import { one } from 'in-page';
     console.log(one, new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));`,
  );
  write('worker.js', `import { two } from '@scope/in-worker'; postMessage(two);`);
  addPackage('in-page', { license: 'MIT', author: { name: 'Ada' }, repository: 'ada/in-page' }, 'one');
  addPackage('@scope/in-worker', { license: 'ISC', author: 'Bob <bob@example.org>' }, 'two');
  addPackage('some-font', { license: 'OFL-1.1' }, 'three');
  addPackage('not-imported', { license: 'MIT' }, 'four');
  write('node_modules/some-font/f.woff2', 'a font');
});

afterEach(() => {
  rmSync(folder, { recursive: true });
});

function write(file: string, content: string): void {
  const target = path.join(folder, file);
  mkdirSync(path.dirname(target), { recursive: true });
  writeFileSync(target, content);
}

/** A package that exports its name, with a licence text. */
function addPackage(name: string, facts: object, exported: string): void {
  const at = `node_modules/${name}`;
  write(`${at}/package.json`, JSON.stringify({ name, version: '1.2.3', main: 'index.mjs', ...facts }));
  write(`${at}/index.mjs`, `export const ${exported} = '${name}';`);
  write(`${at}/LICENSE`, `Terms of ${name}.`);
}

/** Builds the page and reads what was written about licences. */
async function licencesOfPage(): Promise<string> {
  const { page, worker } = licences();
  await build({
    configFile: false,
    root: folder,
    logLevel: 'silent',
    plugins: [page],
    worker: { format: 'es', plugins: () => [worker()] },
    build: { assetsInlineLimit: 0 },
  });
  return readFileSync(path.join(folder, 'dist', 'licences.txt'), 'utf8');
}

it('names the packages of the page, of its workers and of its fonts, with their texts', async () => {
  write('node_modules/in-page/NOTICE.txt', 'Made by Ada.');
  const text = await licencesOfPage();
  expect(text).toContain(
    'in-page 1.2.3\nLicence: MIT\nBy: Ada\nSource: https://github.com/ada/in-page\n\nTerms of in-page.\n\nMade by Ada.\n',
  );
  expect(text).toContain(
    '@scope/in-worker 1.2.3\nLicence: ISC\nBy: Bob <bob@example.org>\n\nTerms of @scope/in-worker.\n',
  );
  expect(text).toContain('some-font 1.2.3\nLicence: OFL-1.1\n\nTerms of some-font.\n');
  expect(text).not.toContain('not-imported');
  expect(text).toContain('The ReactDance contributors');
});

it('says where the source code of a version is that is under the MPL', async () => {
  const address = 'https://registry.npmjs.org/@scope/in-worker/-/in-worker-1.2.3.tgz';
  addPackage('@scope/in-worker', { license: 'MPL-2.0' }, 'two');
  const text = await licencesOfPage();
  expect(text).toContain(
    `@scope/in-worker 1.2.3\nLicence: MPL-2.0\nSource code of this version: ${address}\n`,
  );
  expect(text.match(/Source code of this version/g)).toHaveLength(1);
});

it('names what was copied or rewritten, with its terms', async () => {
  const text = await licencesOfPage();
  for (const [work, holder] of [
    ['@mediapipe/pose', 'Apache License'],
    ['earcut', 'Copyright (c) 2024, Mapbox'],
    ['librosa', 'librosa development team.\n'],
  ] as const) {
    const [, own = ''] = text.split(`\n${'='.repeat(80)}\n${work} `);
    expect(own.split(`\n${'='.repeat(80)}\n`)[0], work).toContain(holder);
  }
});

it.each(['none', 'an empty one'])('fails for a package without a licence text: %s', async (text) => {
  const file = path.join(folder, 'node_modules/@scope/in-worker/LICENSE');
  rmSync(file);
  if (text !== 'none') writeFileSync(file, '\n');
  await expect(licencesOfPage()).rejects.toThrow('@scope/in-worker is in the page, but has no licence text');
});

it.each(['GPL-3.0-only', undefined])('fails for a package under the licence %s', async (license) => {
  addPackage('in-page', { license }, 'one');
  await expect(licencesOfPage()).rejects.toThrow(`in-page is in the page, but its licence (${license})`);
});
