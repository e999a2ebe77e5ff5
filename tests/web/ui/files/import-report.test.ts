import { expect, it } from 'vitest';
import { reported } from '../../../../web/ui/files/import-report';
import type { ModelState } from '../../../../web/ui/store/state';
import { initialState } from '../../../../web/ui/store/store';

it('the report is not made anew with every part of a download', () => {
  const made = (model: ModelState): readonly unknown[] => reported({ ...initialState('dark'), model });
  const loading = (received: number): ModelState => ({
    phase: 'loading',
    label: 'Model',
    received,
    total: 9,
  });
  const ready: ModelState = { phase: 'ready', backend: 'wasm', reason: 'Processor: no WebGPU.', threads: 2 };
  expect(made(loading(1))).toEqual(made(loading(5)));
  expect(made(ready)).not.toEqual(made(loading(9)));
});

it('the report is not made anew with every part of a file that is read', () => {
  const made = (fraction: number): readonly unknown[] =>
    reported({ ...initialState('dark'), reading: { song: { name: 'a.mp3', fraction }, leader: null } });
  expect(made(0.1)).toEqual(made(0.9));
});
