import { iconButton } from '../widgets/button';
import { mountBackendBadge } from './backend-badge';
import { mountFileChip } from '../files/file-chip';
import { el, setAttribute, UNTRANSLATED } from '../widgets/dom';
import { mountDownloadMenu } from '../download/download-menu';
import { brandMark, icon } from '../widgets/icons';
import { mountProjectMenu } from '../project/project-menu';
import type { Mount } from '../store/services';
import { apply, watch } from '../store/store';
import { panelToggled, themeSet } from '../store/actions/view';
import { mountUndo } from '../takes/undo';

/** The bar: name, song and leader, backend, undo, project, keys, theme and download. */
export const mountBar: Mount = (root, store, services) => {
  const theme = iconButton('icon', 'theme', { title: 'Light or dark' }, () => {
    apply(store, themeSet(store.getState().theme === 'dark' ? 'light' : 'dark'));
  });
  const keys = el(
    'button',
    {
      class: 'icon desk',
      attributes: {
        type: 'button',
        'aria-label': 'Keyboard shortcuts',
        'aria-haspopup': 'dialog',
        title: 'Keyboard shortcuts (?)',
      },
      on: {
        click: () => {
          apply(store, panelToggled('keys'));
        },
      },
    },
    icon('keyboard'),
  );
  root.append(
    el(
      'div',
      { class: 'brand' },
      brandMark(),
      // Small windows leave the name out, screen readers have it all the same.
      el('h1', { class: 'visually-hidden', text: 'ReactDance', attributes: UNTRANSLATED }),
      el('span', {
        class: 'name',
        text: 'ReactDance',
        attributes: { 'aria-hidden': 'true', ...UNTRANSLATED },
      }),
    ),
  );
  mountFileChip(root, store, services, 'song');
  mountFileChip(root, store, services, 'leader');
  root.append(el('span', { class: 'grow' }));
  mountBackendBadge(root, store, services);
  root.append(el('span', { class: 'vline' }));
  mountUndo(root, store, services);
  mountProjectMenu(root, store, services);
  root.append(keys, theme);
  mountDownloadMenu(root, store, services);

  watch(
    store,
    (state) => state.theme,
    (value) => {
      theme.setAttribute('aria-label', value === 'dark' ? 'Switch to light' : 'Switch to dark');
    },
  );
  watch(
    store,
    (state) => state.openPanel === 'keys',
    (open) => {
      setAttribute(keys, 'aria-expanded', open ? 'true' : 'false');
    },
  );
};
