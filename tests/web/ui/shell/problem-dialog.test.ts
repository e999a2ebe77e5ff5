import { expect, it } from 'vitest';
import { newerVersion } from '../../../../web/common/page-part';
import { dismissLabel, hintOf } from '../../../../web/ui/shell/problem-dialog';
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

it('a newer version is not the fault of the file, and the hint says what becomes of the work', () => {
  const problem = fileProblem(newerVersion(), 'leader', 'good.bvh');
  expect(problem).toMatchObject({ code: 'newer-version', remedy: 'reload', refused: null });
  expect(problem.title).not.toContain('good.bvh');
  expect(hintOf(problem, { autosave: 'stored' })).toContain('takes and settings stay');
  expect(hintOf(problem, { autosave: 'refused' })).toContain('Save your project first');
});
