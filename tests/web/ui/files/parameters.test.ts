import { describe, expect, it } from 'vitest';
import { readParameters } from '../../../../web/ui/files/parameters';

const BASE = 'https://dance.example/app/';
const SHIPPED = 'https://dance.example/app/models/salsa/manifest.json';

describe('parameters of the page’s address', () => {
  it('default to the shipped model and the best backend', () => {
    expect(readParameters('', BASE)).toEqual({ manifestUrl: SHIPPED, backend: 'auto' });
  });

  it('take a model of the same origin', () => {
    expect(readParameters('?model=/tiny/manifest.json', BASE).manifestUrl).toBe(
      'https://dance.example/tiny/manifest.json',
    );
    expect(readParameters('?model=models/other/manifest.json&backend=wasm', BASE)).toEqual({
      manifestUrl: 'https://dance.example/app/models/other/manifest.json',
      backend: 'wasm',
    });
  });

  it.each([
    'https://elsewhere.example/manifest.json',
    '//elsewhere.example/manifest.json',
    'data:application/json,{}',
    'blob:https://elsewhere.example/1',
    'http://[broken',
  ])('does not take %s', (model) => {
    expect(readParameters(`?model=${encodeURIComponent(model)}`, BASE).manifestUrl).toBe(SHIPPED);
  });

  it('ignore a backend that does not exist', () => {
    expect(readParameters('?backend=cuda', BASE).backend).toBe('auto');
  });
});
