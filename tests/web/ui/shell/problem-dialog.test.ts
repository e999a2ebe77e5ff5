import { expect, it } from 'vitest';
import { dismissLabel } from '../../../../web/ui/shell/problem-dialog';
import { emptyFileProblem, fileProblem, fullProblem } from '../../../../web/ui/store/problems';
import { leader, song } from '../../support/made-state';

const both = { song: song(3), leader: leader(30) };
const [songName, leaderName] = [both.song.name, both.leader.name];

it('the button that closes the dialog names the files that stay', () => {
  const refused = fileProblem(new Error('x'), 'leader', 'bad.bvh');
  expect(dismissLabel(refused, both)).toBe(`Keep ${leaderName}`);
  expect(dismissLabel(refused, { ...both, leader: null })).toBe('Close');
  const unknown = emptyFileProblem('empty.bvh');
  expect(dismissLabel(unknown, both)).toBe(`Keep ${songName} and ${leaderName}`);
  expect(dismissLabel(unknown, { ...both, song: null })).toBe(`Keep ${leaderName}`);
  expect(dismissLabel(fullProblem(), both)).toBe('Close');
});
