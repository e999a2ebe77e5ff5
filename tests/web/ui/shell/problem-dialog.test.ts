import { expect, it } from 'vitest';
import { keepWords } from '../../../../web/ui/shell/problem-dialog';
import { emptyFileProblem, fileProblem, fullProblem } from '../../../../web/ui/store/problems';
import { leader, song } from '../../support/made-state';

const both = { song: song(3), leader: leader(30) };
const [songName, leaderName] = [both.song.name, both.leader.name];

it('the button that closes the dialog names the files that stay', () => {
  const refused = fileProblem(new Error('x'), 'leader', 'bad.bvh');
  expect(keepWords(refused, both)).toBe(`Keep ${leaderName}`);
  expect(keepWords(refused, { ...both, leader: null })).toBe('Close');
  const unknown = emptyFileProblem('empty.bvh');
  expect(keepWords(unknown, both)).toBe(`Keep ${songName} and ${leaderName}`);
  expect(keepWords(unknown, { ...both, song: null })).toBe(`Keep ${leaderName}`);
  expect(keepWords(fullProblem(), both)).toBe('Close');
});
