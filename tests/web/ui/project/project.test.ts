import { expect, it } from 'vitest';
import { openedText } from '../../../../web/ui/project/project';
import { leader, song } from '../../support/made-state';

it('an opened project is named by song, leader and number of takes', () => {
  const files = { song: song(3), leader: leader(30) };
  const names = `${files.song.name}, ${files.leader.name}`;
  expect(openedText({ ...files, takes: [] })).toBe(`Opened: ${names}, no takes`);
  expect(openedText({ song: null, leader: files.leader, takes: [] })).toContain('no song');
});
