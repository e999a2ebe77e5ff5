import { describe, expect, it } from 'vitest';
import { loadingText } from '../../../../web/ui/shell/backend-badge';

const loading = { phase: 'loading', label: 'Model', received: 0, total: 0 } as const;
const part = (name: 'runtime' | 'model', loaded: number, total: number, kept = 0) => ({
  name,
  loaded: loaded * 1e6,
  total: total * 1e6,
  cached: kept * 1e6,
});

describe('the text while the model is loading', () => {
  it('sums up what is downloaded', () => {
    expect(loadingText({ ...loading, parts: [part('runtime', 4, 14.2), part('model', 8, 23.8)] })).toEqual({
      title: 'Runtime and model',
      detail: '12.0 of 38.0 MB',
    });
  });

  it('tells cached files from downloads', () => {
    const parts = [part('runtime', 12, 24), part('model', 23.8, 23.8, 23.8)];
    expect(loadingText({ ...loading, parts })).toEqual({
      title: 'Runtime',
      detail: '12.0 of 24.0 MB, model from this device',
    });
    expect(
      loadingText({ ...loading, parts: parts.map((p) => ({ ...p, loaded: p.total, cached: p.total })) }),
    ).toEqual({ title: 'Runtime and model', detail: 'from this device' });
  });

  it('says what is prepared when nothing is downloaded', () => {
    expect(loadingText({ ...loading, label: 'Warming up' })).toEqual({ title: 'Warming up', detail: '' });
  });
});
