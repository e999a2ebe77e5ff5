import { mkdtempSync, rmSync, symlinkSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { isProgram, root } from '../../../tools/run.mjs';

const [node = '', started = ''] = process.argv;
const program = path.join(root, 'tools/serve.mjs');
let folder: string;

beforeEach(() => {
  folder = mkdtempSync(path.join(tmpdir(), 'reactdance-link-'));
  symlinkSync(path.join(root, 'tools'), path.join(folder, 'tools'), 'junction');
});
afterEach(() => {
  process.argv = [node, started];
  rmSync(folder, { recursive: true });
});

it('a program that is started through a link is the one that was started', () => {
  const url = pathToFileURL(program).href;
  for (const file of [program, path.join(folder, 'tools/serve.mjs')]) {
    process.argv = [node, file];
    expect(isProgram(url)).toBe(true);
  }
  process.argv = [node, path.join(folder, 'tools/start.mjs')];
  expect(isProgram(url)).toBe(false);
  process.argv = [node, 'no-file'];
  expect(isProgram(url)).toBe(false);
});
