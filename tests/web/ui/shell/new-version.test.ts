import { expect, it } from 'vitest';
import { updateText } from '../../../../web/ui/shell/new-version';
import type { Take } from '../../../../web/ui/store/reaction';

it('a new version says before it is loaded that takes would be lost, where there are any', () => {
  const take = (label: string | null) => ({ reaction: { label } }) as Take;
  const lost = 'A new version is ready. Not all takes are kept in this browser: save a project file first.';
  expect(updateText({ autosave: 'stored', takes: [take(null)] })).toBe('A new version is ready.');
  expect(updateText({ autosave: 'full', takes: [take(null), take('demo')] })).toBe(lost);
  expect(updateText({ autosave: 'refused', takes: [take(null)] })).toBe(lost);
  expect(updateText({ autosave: 'refused', takes: [take('demo')] })).toBe('A new version is ready.');
});
