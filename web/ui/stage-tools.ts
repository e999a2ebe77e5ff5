import { el, together } from './dom';
import { icon } from './icons';
import type { Mount } from './services';
import { mountUndo } from './takes/undo-buttons';

/** On the phone, at the stage's lower edge under the thumb: back, forth, and both dancers in the picture again. */
export const mountStageTools: Mount = (root, store, services) => {
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
  return together(undo, () => {
    tools.remove();
  });
};
