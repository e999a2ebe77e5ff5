import { iconButton, textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { coarseMotion, earlierMotion } from '../store/reactor-motion';
import type { Mount } from '../store/services';
import { otherLetter, otherTake } from '../store/take';
import { mountOverlayMenu } from './overlay-menu';
import { radioGroup } from '../widgets/radio-group';
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
  mountUndo(tools, store, services);
  const frame = iconButton('icon', 'frame', { label: 'Frame both', title: 'Frame both' }, services.frameBoth);
  tools.append(frame);
  root.append(tools);
};

/** The dancers' names in their colours; those of ghosts while they are seen. */
const mountLegend: Mount = (root, store) => {
  const item = (role: string, dot: string, name: Node | string): HTMLElement =>
    el('li', { class: role }, el('span', { class: dot }), name);
  const coarse = item('made', 'dot hollow', 'Coarse only');
  const earlier = item('made', 'dot hollow', 'Before');
  const otherName = el('span');
  const other = item('made', 'dot hollow', otherName);
  const legend = el(
    'ul',
    { class: 'over legend' },
    item('leader', 'dot', 'Leader'),
    item('reactor', 'dot', 'Reactor'),
    coarse,
    earlier,
    other,
  );
  root.append(legend);
  watchAll(
    store,
    (state) => [coarseMotion(state), earlierMotion(state), state.compare, state.letter, otherTake(state)],
    (state) => {
      coarse.hidden = coarseMotion(state) === null;
      earlier.hidden = earlierMotion(state) === null;
      other.hidden = state.compare !== 'ghost' || otherTake(state) === null;
      setText(otherName, `Take ${otherLetter(state.letter)}`);
    },
  );
};

/** Over the picture: the legend, the cameras, overlays and stage tools. */
export const mountStageControls: Mount = (root, store, services) => {
  const cameras = radioGroup('Camera', CAMERAS, (camera) => {
    apply(store, cameraSet(camera));
  });
  const frame = textButton('btn once', 'Frame both', services.frameBoth);
  const views = el('div', { class: 'over views' }, cameras.element, frame);
  mountLegend(root, store, services);
  root.append(views);
  mountOverlayMenu(root, store, services);
  mountStageTools(root, store, services);
  watch(store, (state) => state.camera, cameras.show);
};
