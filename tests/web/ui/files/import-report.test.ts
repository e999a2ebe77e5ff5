import { expect, it } from 'vitest';
import { aboutModel, reported } from '../../../../web/ui/files/import-report';
import type { ModelState } from '../../../../web/ui/store/state';
import { initialState } from '../../../../web/ui/store/store';
import { small } from '../../support/small-manifest';

it('the report is not made anew with every part of a download', () => {
  const made = (model: ModelState): readonly unknown[] => reported({ ...initialState('dark'), model });
  const loading = (received: number): ModelState => ({
    phase: 'loading',
    label: 'Model',
    received,
    total: 9,
  });
  const ready: ModelState = { phase: 'ready', backend: 'wasm', reason: 'Processor: no WebGPU.' };
  expect(made(loading(1))).toEqual(made(loading(5)));
  expect(made(ready)).not.toEqual(made(loading(9)));
});

it('the report is not made anew with every part of a file that is read', () => {
  const made = (fraction: number): readonly unknown[] =>
    reported({ ...initialState('dark'), reading: { song: { name: 'a.mp3', fraction }, leader: null } });
  expect(made(0.1)).toEqual(made(0.9));
});

it('tells the licences, origin and notes of a model', () => {
  const model = {
    ...small,
    licence: { weights: 'CC BY 4.0', data: 'not stated' },
    attribution: 'a school of tango',
    notes: ['One couple.', 'No fingers.'],
  };
  expect(aboutModel(model)).toEqual([
    ['Licence', 'CC BY 4.0'],
    ['Data', 'not stated'],
    ['From', 'a school of tango'],
    ['Note', 'One couple.'],
    ['Note', 'No fingers.'],
  ]);
});
