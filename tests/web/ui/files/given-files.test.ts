import { describe, expect, it } from 'vitest';
import { createInOrder } from '../../../../web/ui/files/dropped';
import { openGiven, sortedFiles } from '../../../../web/ui/files/given-files';
import * as change from '../../support/actions';

const song = (name: string): File => new File(['ID3 sound'], name);
const leader = (name: string): File => new File(['HIERARCHY\nROOT Hips'], name);
const photo = (name: string): File => new File([Uint8Array.of(0xff, 0xd8, 0xff, 0xe0)], name);

/** Opens files, where others wait to be chosen from, and says what was read and what is shown. */
async function opened(...files: File[]) {
  const store = change.createAppStore('dark');
  change.apply(store, change.givenSet({ songs: [[song('older.mp3')]], leaders: [], unused: [] }));
  const read: string[] = [];
  const reader = {
    open: (all: readonly File[]) => {
      read.push(...all.map(({ name }) => name));
      return Promise.resolve();
    },
  };
  await openGiven(files, store, reader, createInOrder());
  const { given, problem, queuedProblems } = store.getState();
  return { read, given, problem, queuedProblems };
}

describe('files that are given together', () => {
  it('are read at once when they are a song and a leader, or one file of any kind', async () => {
    expect(await opened(song('a.mp3'), leader('b.bvh'))).toMatchObject({
      read: ['a.mp3', 'b.bvh'],
      given: null,
    });
    expect(await opened(photo('c.jpg'))).toMatchObject({ read: ['c.jpg'], given: null });
  });

  it('are asked about when there are two songs or two leaders', async () => {
    const { read, given } = await opened(song('a.mp3'), leader('b.bvh'), song('c.mp3'), leader('d.bvh'));
    expect(read).toEqual([]);
    expect(given?.songs.map(([file]) => file?.name)).toEqual(['a.mp3', 'c.mp3']);
    expect(given?.leaders.map(([file]) => file?.name)).toEqual(['b.bvh', 'd.bvh']);
  });

  it('are one list with a sentence for each kind that is of no use', async () => {
    const photos = Array.from({ length: 40 }, (_, i) => photo(`photo ${i}.jpg`));
    const notes = new File(['words'], 'notes.txt');
    const { unused } = await sortedFiles([...photos, notes, new File([], 'nothing.bvh')]);
    expect(unused).toEqual([
      '40 files are pictures.',
      'nothing.bvh is empty.',
      'notes.txt is neither a song, a video nor a motion.',
    ]);
    const { given, problem } = await opened(...photos, song('a.mp3'));
    expect(given).toMatchObject({ leaders: [], unused: ['40 files are pictures.'] });
    expect(problem).toBeNull();
  });

  it('are one problem when none is of use', async () => {
    const photos = Array.from({ length: 40 }, (_, i) => photo(`photo ${i}.jpg`));
    const { given, problem, queuedProblems } = await opened(...photos);
    expect(given).toBeNull();
    expect(problem?.title).toBe('None of the 40 files is a song or a leader.');
    expect(problem?.hint).toContain('40 files are pictures.');
    expect(queuedProblems).toEqual([]);
  });
});
