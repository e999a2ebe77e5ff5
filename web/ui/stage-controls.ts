import { el, together } from './dom';
import { coarseMotion } from './reactor-motion';
import type { Mount } from './services';
import { mountShowMenu } from './show-menu';
import { mountStageTools } from './stage-tools';
import type { Camera } from './state';
import { apply, watch } from './store';
import { cameraSet } from './view-changes';

const CAMERAS: readonly (readonly [Camera, string])[] = [
  ['orbit', 'Orbit'],
  ['follow', 'Follow'],
  ['top', 'Top'],
  ['side', 'Side'],
];

/** Over the picture: who is who, and from where it is seen. */
export const mountStageControls: Mount = (root, store, services) => {
  const coarse = el('li', { class: 'made' }, el('span', { class: 'dot hollow' }), 'Coarse only');
  const legend = el(
    'ul',
    { class: 'over legend' },
    el('li', { class: 'lead' }, el('span', { class: 'dot' }), 'Leader'),
    el('li', { class: 'reac' }, el('span', { class: 'dot' }), 'Reactor'),
    coarse,
  );
  const select = (camera: Camera): void => {
    apply(store, cameraSet(camera));
  };
  const buttons = CAMERAS.map(([camera, label]) =>
    el('button', {
      class: 'btn',
      text: label,
      attributes: { type: 'button', role: 'radio' },
      on: {
        click: () => {
          select(camera);
        },
        keydown: (event) => {
          const move = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
          if (move === undefined) return;
          event.preventDefault();
          event.stopPropagation();
          const index = CAMERAS.findIndex(([name]) => name === camera);
          const next = (index + move + CAMERAS.length) % CAMERAS.length;
          select(CAMERAS[next]?.[0] ?? camera);
          buttons[next]?.focus();
        },
      },
    }),
  );
  const group = el(
    'div',
    { class: 'group', attributes: { role: 'radiogroup', 'aria-label': 'Camera' } },
    ...buttons,
  );
  const frame = el('button', {
    class: 'btn once',
    text: 'Frame both',
    attributes: { type: 'button' },
    on: {
      click: () => {
        services.frameBoth();
      },
    },
  });
  const views = el('div', { class: 'over views' }, group, frame);
  root.append(legend, views);

  return together(
    mountShowMenu(root, store, services),
    mountStageTools(root, store, services),
    watch(
      store,
      (state) => coarseMotion(state) !== null,
      (seen) => {
        coarse.hidden = !seen;
      },
    ),
    watch(
      store,
      (state) => state.camera,
      (shown) => {
        CAMERAS.forEach(([camera], index) => {
          buttons[index]?.setAttribute('aria-checked', String(camera === shown));
          buttons[index]?.setAttribute('tabindex', camera === shown ? '0' : '-1');
        });
      },
    ),
    () => {
      legend.remove();
      views.remove();
    },
  );
};
