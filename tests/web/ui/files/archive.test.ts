import { strToU8, type Zippable, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { writeMotion } from '../../../../web/export/client';
import { unpacked } from '../../../../web/ui/files/archive';
import { sortedFiles } from '../../../../web/ui/files/given-files';
import { storedProject } from '../../../../web/ui/project/stored-project';
import { writeProject } from '../../../../web/ui/project/project-file';
import * as change from '../../support/actions';
import { leader } from '../../support/made-state';
import { small } from '../../support/small-manifest';
import { madeDance } from '../../support/made-dance';

const archive = (name: string, entries: Zippable): File => new File([zipSync(entries)], name);
const given = (...files: File[]) => files.map((file) => ({ path: file.name, file }));

/** Paths and names of what was found, with the text of each file. */
async function found(...files: File[]): Promise<[string, string, string][]> {
  const all = await unpacked(given(...files));
  return Promise.all(
    all.map(async ({ path, file }) => [path, file.name, await file.text()] as [string, string, string]),
  );
}

describe('zip archives among given files', () => {
  it('give their files, without folders and what systems add', async () => {
    const takes = archive('takes.ZIP', {
      'day 1': { 'salsa.bvh': strToU8('HIERARCHY'), '.DS_Store': strToU8('x') },
      __MACOSX: { '._salsa.bvh': strToU8('x') },
      'song.mp3': strToU8('ID3'),
      'Thumbs.db': strToU8('x'),
      'back\\slash.bvh': strToU8('HIERARCHY 2'),
    });
    expect(await found(new File(['first'], 'first.bvh'), takes)).toEqual([
      ['first.bvh', 'first.bvh', 'first'],
      ['takes.ZIP/day 1/salsa.bvh', 'salsa.bvh', 'HIERARCHY'],
      ['takes.ZIP/song.mp3', 'song.mp3', 'ID3'],
      ['takes.ZIP/back\\slash.bvh', 'slash.bvh', 'HIERARCHY 2'],
    ]);
  });

  it('are unpacked part by part, so that the page goes on meanwhile', async () => {
    const takes = Array.from({ length: 5 }, (_, i) => [`${i}.bvh`, new Uint8Array(5e6).fill(i)] as const);
    let turns = 0;
    const turning = setInterval(() => turns++);
    const files = await unpacked(given(archive('takes.zip', Object.fromEntries(takes))));
    clearInterval(turning);
    expect(files.map(({ file }) => [file.name, file.size])).toEqual(takes.map(([name]) => [name, 5e6]));
    expect(new Uint8Array(await files[3]!.file.arrayBuffer()).every((value) => value === 3)).toBe(true);
    expect(turns).toBeGreaterThan(1);
  });

  it('give both dancers of a BVH that the page wrote', async () => {
    const blob = await writeMotion('bvh', madeDance(30, 'leader', 'reactor'), 'dark');
    const files = await unpacked(given(new File([blob], 'dance_both-bvh.zip')));
    const { leaders } = await sortedFiles(files.map(({ file }) => file));
    expect(leaders.map(([file]) => file?.name)).toEqual(['leader.bvh', 'reactor.bvh']);
  });

  it('stay as they are where they are projects or arrays, or no archives at all', async () => {
    const store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    change.apply(store, change.leaderLoaded(leader(60)));
    const project = await writeProject(storedProject(store.getState()));
    const renamed = await found(new File([project], 'mine.zip'));
    expect(renamed.map(([, name]) => name)).toEqual(['mine.reactdance']);
    for (const name of ['mine.reactdance', 'mine.reactdance.zip', 'arrays.npz'])
      expect((await found(new File([project], name))).map(([path]) => path)).toEqual([name]);
    expect(await found(new File(['words'], 'words.zip'))).toEqual([['words.zip', 'words.zip', 'words']]);
  });

  it.each([
    ['archive-empty', () => archive('no.zip', { folder: {} })],
    ['archive-damaged', () => new File([zipSync({ 'a.bvh': strToU8('abc') }).slice(0, 20)], 'cut.zip')],
    [
      'archive-damaged',
      () => {
        const bytes = zipSync({ 'a.bvh': strToU8('HIERARCHY '.repeat(100)) });
        return new File([bytes.fill(0xff, 40, 50)], 'broken.zip');
      },
    ],
    [
      'archive-too-large',
      () => {
        // Says in its directory, whose entry begins with PK 1 2, that it unpacks to 1 GB.
        const bytes = zipSync({ 'a.bvh': strToU8('HIERARCHY') });
        const entry = bytes.findIndex((_, i) => bytes.subarray(i, i + 4).join() === '80,75,1,2');
        new DataView(bytes.buffer).setUint32(entry + 24, 2 ** 30, true);
        return new File([bytes], 'large.zip');
      },
    ],
    [
      'archive-too-large',
      () =>
        new File(['PK', ...Array<Uint8Array<ArrayBuffer>>(257).fill(new Uint8Array(2 ** 20))], 'large.zip'),
    ],
  ])('are refused with %s', async (code, file) => {
    await expect(unpacked(given(file()))).rejects.toMatchObject({
      code,
      message: expect.stringMatching(/^(no|cut|broken|large)\.zip /) as unknown,
    });
  });
});
