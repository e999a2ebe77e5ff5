import type { Theme } from '../../common/picture';
import { generatedRole } from '../store/roles';
import { type Store, watch } from '../store/store';

const system = (): MediaQueryList => matchMedia('(prefers-color-scheme: light)');

export function systemTheme(): Theme {
  return system().matches ? 'light' : 'dark';
}

/** Calls back when the system changes its theme; returns the unsubscription. */
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

/** Gives the style sheets the theme and the generated dancer's role, which they colour some controls by. */
export function mountTheme(store: Store): void {
  watch(store, (state) => state.theme, showTheme);
  watch(store, generatedRole, (role) => {
    document.documentElement.dataset['made'] = role;
  });
}

/** Shows a theme on the page and in the browser's own frame. */
function showTheme(theme: Theme): void {
  document.documentElement.dataset['theme'] = theme;
  const colour = getComputedStyle(document.documentElement).getPropertyValue('--panel').trim();
  document.querySelector('meta[name="theme-color"]')?.setAttribute('content', colour);
}
