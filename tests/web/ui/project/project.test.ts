import { expect, it } from 'vitest';
import { openedWords } from '../../../../web/ui/project/project';
import { leader, song } from '../../support/made-state';

it('an opened project is named by song, leader and number of takes', () => {
  const files = { song: song(3), leader: leader(30) };
  const names = `${files.song.name}, ${files.leader.name}`;
  expect(openedWords({ ...files, takes: [] })).toBe(`Opened: ${names}, no takes`);
  expect(openedWords({ song: null, leader: files.leader, takes: [] })).toContain('no song');
});
