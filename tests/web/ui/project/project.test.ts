import { expect, it } from 'vitest';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import { openedText, Project } from '../../../../web/ui/project/project';
import { writeProject } from '../../../../web/ui/project/project-file';
import { storedProject } from '../../../../web/ui/project/schema';
import { undone } from '../../../../web/ui/store/history/history';
import type { FileReaders } from '../../../../web/ui/store/services';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, leaderFile, numbered, song, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

it('an opened project is named by song, leader and number of takes', () => {
  const files = { song: song(3), leader: leader(30) };
  const names = `${files.song.name}, ${files.leader.name}`;
  expect(openedText({ ...files, takes: [] })).toBe(`Opened: ${names}, no takes`);
  expect(openedText({ song: null, leader: files.leader, takes: [] })).toContain('no song');
});

/** A page with a take for each leader, the last of which is on the page. */
function pageOf(...leaders: readonly string[]): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  for (const name of leaders) {
    change.apply(store, change.leaderLoaded(leader(30, name)));
    const inputs = currentInputs(store.getState())!;
    const reaction = { motion: numbered(30, 1), latents: null, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id: `of ${name}`, at: 1e6 * name.length }));
  }
  return store;
}

it('a project opened while an earlier visit is still being read replaces all of it, and undo brings all back', async () => {
  const earlier = storedProject(pageOf('second.bvh', 'first.bvh').getState());
  const file = new File([await writeProject(storedProject(pageOf('new.bvh').getState()))], 'new.zip');
  const store = change.createAppStore('dark');
  let goOn = (): void => undefined;
  const held = new Promise<void>((resolve) => (goOn = resolve));
  const readers: FileReaders = {
    loadSong: () => Promise.reject(new Error('There is no song.')),
    readLeader: async ({ files }) => {
      if (files[0]!.name === 'second.bvh') await held;
      return { file: leaderFile(30), motion: still(30) };
    },
    manifest: () => {
      change.apply(store, change.manifestLoaded(small, 7));
      return Promise.resolve(small);
    },
  };
  const project = new Project(store, new FileLoader(store, readers, () => Promise.resolve()), readers, {
    stage: () => null,
    storage: {
      read: () => Promise.resolve({ ...earlier, songs: [] }),
      write: () => Promise.resolve(),
      removeOwn: () => Promise.resolve(),
      clear: () => Promise.resolve(),
    },
    tabs: { locks: undefined, channel: undefined },
    persistence: { persisted: () => Promise.resolve(true), persist: () => Promise.resolve(true) },
  });
  const takes = (): string[] => store.getState().takes.map(({ id }) => id);
  try {
    expect(await project.restore()).toBe(true);
    expect(takes()).toEqual(['of first.bvh']);
    const opened = project.open(file);
    await new Promise((resolve) => setTimeout(resolve, 50));
    goOn();
    expect(await opened).toBe(true);
    expect(takes()).toEqual(['of new.bvh']);
    change.apply(store, undone());
    expect(takes().sort()).toEqual(['of first.bvh', 'of second.bvh']);
  } finally {
    project.dispose();
  }
});
