import type { Theme } from '../store/state';

const system = (): MediaQueryList => matchMedia('(prefers-color-scheme: light)');

export function systemTheme(): Theme {
  return system().matches ? 'light' : 'dark';
}

/** Tells when the system changes its theme; returns how to stop. */
export function watchSystemTheme(change: (theme: Theme) => void): () => void {
  const query = system();
  const listener = (): void => {
    change(systemTheme());
  };
  query.addEventListener('change', listener);
  return () => {
    query.removeEventListener('change', listener);
  };
}

/** Shows a theme, in the browser's own frame too. */
export function showTheme(theme: Theme): void {
  document.documentElement.dataset.theme = theme;
  const colour = getComputedStyle(document.documentElement).getPropertyValue('--panel').trim();
  document.querySelector('meta[name="theme-color"]')?.setAttribute('content', colour);
}
