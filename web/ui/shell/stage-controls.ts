import { el, combineDisposers } from '../widgets/dom';
import { coarseMotion, earlierMotion } from '../store/reactor-motion';
import type { Mount } from '../store/services';
import { mountOverlayMenu } from './overlay-menu';
import { icon } from '../widgets/icons';
import { mountUndo } from '../takes/undo';
import type { View } from '../../common/framing';
import { apply, watch, watchAll } from '../store/store';
import { cameraSet } from '../store/actions/view';

const CAMERAS: readonly (readonly [View, string])[] = [
  ['orbit', 'Orbit'],
  ['follow', 'Follow'],
  ['top', 'Top'],
  ['side', 'Side'],
];

/** On the phone, at the stage's lower edge: undo, redo and framing both dancers. */
const mountStageTools: Mount = (root, store, services) => {
  const tools = el('div', {
    class: 'over tools',
    attributes: { role: 'group', 'aria-label': 'Stage tools' },
  });
  const undo = mountUndo(tools, store, services);
  const frame = el(
    'button',
    {
      class: 'icon',
      attributes: { type: 'button', 'aria-label': 'Frame both', title: 'Frame both' },
      on: {
        click: () => {
          services.frameBoth();
        },
      },
    },
    icon('frame'),
  );
  tools.append(frame);
  root.append(tools);
  return combineDisposers(undo, () => {
    tools.remove();
  });
};

/** The dancers' names in their colours; those of ghosts while they are seen. */
const mountLegend: Mount = (root, store) => {
  const item = (role: string, dot: string, name: string): HTMLElement =>
    el('li', { class: role }, el('span', { class: dot }), name);
  const coarse = item('made', 'dot hollow', 'Coarse only');
  const earlier = item('made', 'dot hollow', 'Before');
  const legend = el(
    'ul',
    { class: 'over legend' },
    item('leader', 'dot', 'Leader'),
    item('reactor', 'dot', 'Reactor'),
    coarse,
    earlier,
  );
  root.append(legend);
  const stop = watchAll(
    store,
    (state) => [coarseMotion(state), earlierMotion(state)],
    (state) => {
      coarse.hidden = coarseMotion(state) === null;
      earlier.hidden = earlierMotion(state) === null;
    },
  );
  return combineDisposers(stop, () => {
    legend.remove();
  });
};

/** Over the picture: the legend, the cameras, overlays and stage tools. */
export const mountStageControls: Mount = (root, store, services) => {
  const select = (camera: View): void => {
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
  const legend = mountLegend(root, store, services);
  root.append(views);

  return combineDisposers(
    legend,
    mountOverlayMenu(root, store, services),
    mountStageTools(root, store, services),
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
      views.remove();
    },
  );
};
