import { el } from '../widgets/dom';
import { droppedFiles } from './dropped';
import type { Mount } from '../store/services';

/** Opens files that are dropped anywhere on the page; while they are dragged over it, the stage shows an overlay. */
export const mountDropTarget: Mount = (root, _store, services) => {
  const overlay = el(
    'div',
    { class: 'drop-overlay', attributes: { 'aria-hidden': 'true' } },
    el('b', { text: 'Drop it anywhere' }),
    el('span', { text: 'A leader as video or motion file, a song, or both; a project; a model as a folder' }),
  );
  overlay.hidden = true;
  root.append(overlay);

  // Moving between two elements enters one and leaves the other, so enters minus leaves tell whether files hover.
  let depth = 0;
  const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const show = (change: number): void => {
    depth = Math.max(0, depth + change);
    overlay.hidden = depth === 0;
  };
  window.addEventListener('dragenter', (event) => {
    if (carriesFiles(event)) show(1);
  });
  window.addEventListener('dragleave', (event) => {
    if (carriesFiles(event)) show(-1);
  });
  window.addEventListener('dragover', (event) => {
    if (carriesFiles(event)) event.preventDefault();
  });
  window.addEventListener('drop', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    show(-depth);
    if (event.dataTransfer) services.openDropped(droppedFiles(event.dataTransfer));
  });
};
