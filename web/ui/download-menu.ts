import { writeBvh } from '../motion/bvh-write';
import { el, setAttribute, setText, together } from './dom';
import { byteSize } from './format';
import { icon } from './icons';
import { reactorMotion } from './reactor-motion';
import { reactorFileName } from './selectors';
import type { Mount } from './services';
import type { AppState } from './state';
import { apply, opened, watch, watchAll } from './store';

/** The Download button and its menu: what can be taken home, how large it is and what it will be called. */
export const mountDownloadMenu: Mount = (root, store, services) => {
  const toggle = (): void => {
    apply(store, opened('download'));
  };
  const attributes = { type: 'button', 'aria-haspopup': 'dialog' };
  const wide = el(
    'button',
    { class: 'btn primary desk', attributes, on: { click: toggle } },
    icon('download'),
    'Download',
  );
  const narrow = el(
    'button',
    {
      class: 'icon phone-only',
      attributes: { ...attributes, 'aria-label': 'Download' },
      on: { click: toggle },
    },
    icon('share'),
  );
  const size = el('em');
  const save = el(
    'button',
    {
      class: 'it',
      attributes: { type: 'button' },
      on: {
        click: () => {
          services.saveReactor();
        },
      },
    },
    el('b', { text: 'BVH' }),
    el('span', { text: 'Skeleton with rest pose, for Blender, Maya, MotionBuilder' }),
    size,
  );
  const fileName = el('b');
  const file = el('div', { class: 'file' }, 'Saved as', fileName);
  const menu = el(
    'div',
    { class: 'float menu', attributes: { role: 'dialog', 'aria-label': 'Download' } },
    el(
      'div',
      { class: 'row' },
      el('h2', { text: 'Motion of the reactor' }),
      el(
        'button',
        { class: 'icon', attributes: { type: 'button', 'aria-label': 'Close' }, on: { click: toggle } },
        icon('close'),
      ),
    ),
    save,
    file,
  );
  menu.hidden = true;
  root.append(wide, narrow, menu);

  const showReaction = (state: AppState): void => {
    const { reaction } = state;
    wide.disabled = narrow.disabled = save.disabled = reaction === null;
    wide.title = reaction ? '' : 'Ready when a reactor is on the stage';
    if (reaction) setText(fileName, reactorFileName(reaction.inputs));
    if (!menu.hidden) showSize(state);
  };
  /** The size is that of the very text that would be saved; it is only written out when someone looks. */
  const showSize = (state: AppState): void => {
    const motion = reactorMotion(state);
    setText(size, motion ? byteSize(writeBvh(motion).length) : '');
  };
  const showOpen = (open: boolean): void => {
    const before = menu.hidden;
    menu.hidden = !open;
    for (const button of [wide, narrow]) setAttribute(button, 'aria-expanded', open ? 'true' : 'false');
    if (open) {
      showSize(store.getState());
      save.focus();
    } else if (!before && menu.contains(document.activeElement)) {
      (wide.offsetParent ? wide : narrow).focus();
    }
  };
  const closeOutside = (event: PointerEvent): void => {
    const target = event.target as Node;
    if (!menu.hidden && ![menu, wide, narrow].some((part) => part.contains(target))) toggle();
  };
  document.addEventListener('pointerdown', closeOutside);
  return together(
    watchAll(store, (state) => [state.reaction, state.footLock], showReaction),
    watch(store, (state) => state.open === 'download', showOpen),
    () => {
      document.removeEventListener('pointerdown', closeOutside);
      wide.remove();
      narrow.remove();
      menu.remove();
    },
  );
};
