import { afterEach, expect, it, vi } from 'vitest';
import { onPixelSize } from '../../../web/common/pixel-size';

afterEach(() => {
  vi.unstubAllGlobals();
});

/** A window whose screen density can be changed, as browsers tell of it: a query tells once that it holds no more. */
function densityOf(start: number): { readonly set: (density: number) => void } {
  const queries = new Map<string, EventTarget>();
  const page = { devicePixelRatio: start };
  const query = (density: number): string => `(resolution: ${density}dppx)`;
  vi.stubGlobal('window', page);
  vi.stubGlobal('matchMedia', (text: string) => {
    const target = new EventTarget();
    queries.set(text, target);
    return target;
  });
  vi.stubGlobal(
    'ResizeObserver',
    class {
      observe = (): void => undefined;
      disconnect = (): void => undefined;
    },
  );
  return {
    set: (density) => {
      const before = queries.get(query(page.devicePixelRatio));
      page.devicePixelRatio = density;
      before?.dispatchEvent(new Event('change'));
    },
  };
}

it('tells of every change of the screen density', () => {
  const density = densityOf(1);
  const listener = vi.fn();
  onPixelSize({} as Element, listener);
  density.set(2);
  density.set(1.5);
  expect(listener).toHaveBeenCalledTimes(2);
});
