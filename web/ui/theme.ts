import type { Theme } from './state';

const KEY = 'reactdance.theme';

/** The theme that was chosen here before, else the system's. */
export function firstTheme(): Theme {
  const kept = read();
  if (kept === 'dark' || kept === 'light') return kept;
  return matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark';
}

/** Shows a theme; what was chosen by hand is kept for the next visit where the browser allows. */
export function showTheme(theme: Theme, keep: boolean): void {
  document.documentElement.dataset.theme = theme;
  const colour = getComputedStyle(document.documentElement).getPropertyValue('--panel').trim();
  document.querySelector('meta[name="theme-color"]')?.setAttribute('content', colour);
  if (!keep) return;
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Full or forbidden storage: the choice lasts for this visit.
  }
}

/** Follows the system while nobody has chosen; returns how to stop. */
export function followSystemTheme(change: (theme: Theme) => void): () => void {
  const query = matchMedia('(prefers-color-scheme: light)');
  const listener = (): void => {
    if (read() === null) change(query.matches ? 'light' : 'dark');
  };
  query.addEventListener('change', listener);
  return () => {
    query.removeEventListener('change', listener);
  };
}

function read(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}
