/** The built page carries the licence texts of everything in it (tools/vite/licences.mjs). */
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { expect, test } from '@playwright/test';

const project = path.resolve(import.meta.dirname, '../..');
const read = (file: string): string => readFileSync(path.join(project, file), 'utf8');
const written = read('dist/licences.txt');

/** What is written about a package: facts and texts. */
function section(name: string): string {
  const { version } = JSON.parse(read(`node_modules/${name}/package.json`)) as { version: string };
  const [, found = ''] = written.split(`\n${'='.repeat(80)}\n${name} ${version}\n`);
  return found.split(`\n${'='.repeat(80)}\n`)[0] ?? '';
}

const { dependencies } = JSON.parse(read('package.json')) as { dependencies: Record<string, string> };

for (const name of Object.keys(dependencies)) {
  test(`the page has the licence of ${name}`, () => {
    const files = readdirSync(path.join(project, 'node_modules', name));
    const texts = files.filter((file) => /^licen[cs]e/i.test(file));
    // The packages of onnxruntime bring none.
    expect(texts.length).toBe(name.startsWith('onnxruntime') ? 0 : 1);
    for (const file of texts) expect(section(name)).toContain(read(`node_modules/${name}/${file}`).trim());
    expect(section(name).length).toBeGreaterThan(700);
  });
}

test('the page has the licences of packages inside other packages', () => {
  expect(section('onnxruntime-web')).toContain('Copyright (c) Microsoft Corporation');
  for (const part of ['Eigen', 'google/flatbuffers', 'abseil-cpp', 'google/XNNPACK', 'dawn'])
    expect(section('onnxruntime-web')).toContain(`\n${part}\n`);
  expect(section('onnxruntime-common')).toContain('Copyright (c) Microsoft Corporation');
  expect(section('@mediabunny/aac-encoder')).toContain('GNU LESSER GENERAL PUBLIC LICENSE');
  expect(section('@mediabunny/aac-encoder')).toContain('END OF TERMS AND CONDITIONS');
  for (const tool of ['vite', 'rolldown']) expect(section(tool)).toContain('VoidZero Inc.');
});

test('WebAssembly has the licences of the libraries that it was linked with', () => {
  for (const name of ['onnxruntime-web', '@mediabunny/aac-encoder'])
    for (const library of ['Emscripten authors', 'Rich Felker', 'LLVM Exceptions'])
      expect(section(name), name).toContain(library);
});

/** What is written about a work that is no installed package. */
function sectionOfCopy(name: string, version: string): string {
  const [, found = ''] = written.split(`\n${'='.repeat(80)}\n${name} ${version}\n`);
  return found.split(`\n${'='.repeat(80)}\n`)[0] ?? '';
}

test('what three has copied from others is named', () => {
  const copies = [
    ...read('node_modules/three/build/three.core.js').matchAll(/copy of \w+\/(\w+) version ([\d.]+)/g),
  ];
  expect(copies.map(([, name]) => name)).toEqual(['earcut']);
  for (const [, name = '', version = ''] of copies)
    expect(sectionOfCopy(name, version), name).toContain('Copyright (c) 2024, Mapbox');
});

test("librosa's terms are there, in the version that the features are rewritten from", () => {
  const [, version = ''] = /^librosa==([\d.]+)$/m.exec(read('constraints.txt')) ?? [];
  expect(sectionOfCopy('librosa', version)).toContain('librosa development team');
});

test('the source code of what is under MPL and LGPL can be found', () => {
  for (const name of ['mediabunny', '@mediabunny/aac-encoder']) {
    const { version } = JSON.parse(read(`node_modules/${name}/package.json`)) as { version: string };
    const file = `${name}/-/${path.posix.basename(name)}-${version}.tgz`;
    expect(section(name)).toContain(`Source code of this version: https://registry.npmjs.org/${file}\n`);
    expect(readdirSync(path.join(project, 'node_modules', name))).toContain('src');
  }
  const encoder = read('node_modules/@mediabunny/aac-encoder/dist/bundles/mediabunny-aac-encoder.mjs');
  const [state = 'none'] = /Lavc[\d.]+/.exec(encoder) ?? [];
  expect(section('@mediabunny/aac-encoder')).toContain(`calls itself ${state}:`);
  const files = readdirSync(path.join(project, 'dist/assets'));
  const withFfmpeg = files.filter(
    (file) => /\.js$/.test(file) && read(`dist/assets/${file}`).includes(state),
  );
  expect(withFfmpeg).toEqual([expect.stringMatching(/^mediabunny-aac-encoder-[\w-]+\.js$/)]);
});

test('what mediabunny says to be based on the work of others is named', () => {
  const folder = 'node_modules/mediabunny/dist/modules/src';
  const sources = readdirSync(path.join(project, folder)).filter((file) => file.endsWith('.js'));
  const based = sources.flatMap((file) => read(`${folder}/${file}`).match(/Based on \w+\.c from \w+/g) ?? []);
  expect(based).toEqual(['Based on vorbis_parser.c from FFmpeg']);
  expect(section('mediabunny')).toContain('vorbis_parser.c of FFmpeg');
});

test('the page has the licence of the networks that find a dancer in a video', () => {
  const [, pose = ''] = written.split('\n@mediapipe/pose 0.5.1675469404\n');
  const [own = ''] = pose.split(`\n${'='.repeat(80)}\n`);
  expect(own).toContain('Apache License\n                           Version 2.0, January 2004');
  expect(own).toContain('END OF TERMS AND CONDITIONS');
  expect(own).toContain('converted to ONNX');
});

test('all that meyda has bundled is named', () => {
  const { sources } = JSON.parse(read('node_modules/meyda/dist/web/meyda.min.js.map')) as {
    sources: string[];
  };
  const inside = new Set(sources.flatMap((file) => /node_modules\/([^/]+)/.exec(file)?.[1] ?? []));
  expect([...inside].sort()).toEqual(['dct', 'fftjs', 'tslib']);
  for (const name of ['dct', 'fftjs']) expect(section(name)).toContain('Permission is hereby granted');
  expect(section('meyda')).toContain('tslib, which is under the licence 0BSD');
});

test('THIRD_PARTY.md names every work of licences.txt', () => {
  const table = read('THIRD_PARTY.md')
    .split('\n')
    .filter((row) => row.startsWith('| '));
  const names = [...written.matchAll(/^={80}\n(\S+) \d\S*$/gm)].flatMap(([, name]) => name ?? []);
  expect(names).toEqual(expect.arrayContaining(['three', 'earcut', 'librosa', '@mediapipe/pose']));
  const unnamed = names.filter((name) => !table.some((row) => row.split(/[\s,|]+/).includes(name)));
  expect(unnamed).toEqual([]);
});

test('THIRD_PARTY.md names every package of the page with its version', () => {
  const rows = read('THIRD_PARTY.md').split('\n');
  const { devDependencies } = JSON.parse(read('package.json')) as { devDependencies: { vite: string } };
  for (const [name, version] of Object.entries({ ...dependencies, vite: devDependencies.vite }))
    expect(rows.filter((row) => row.includes(name) && row.includes(`| ${version} |`))).toHaveLength(1);
});
