import { el, listen, together } from '../widgets/dom';
import { droppedFiles } from './dropped';
import type { Mount } from '../store/services';

/** The whole page takes files; while one hovers, the stage says so. */
export const mountDropTarget: Mount = (root, _store, services) => {
  const landing = el(
    'div',
    { class: 'landing', attributes: { 'aria-hidden': 'true' } },
    el('b', { text: 'Drop it anywhere' }),
    el('span', { text: 'A song, a leader as BVH, or both at once; a project; a model as a folder' }),
  );
  landing.hidden = true;
  root.append(landing);

  // Leaving is judged by what fires next: moving between two elements leaves one and enters the other.
  let inside = 0;
  const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const show = (change: number): void => {
    inside = Math.max(0, inside + change);
    landing.hidden = inside === 0;
  };
  return together(
    listen(window, 'dragenter', (event) => {
      if (carriesFiles(event)) show(1);
    }),
    listen(window, 'dragleave', (event) => {
      if (carriesFiles(event)) show(-1);
    }),
    listen(window, 'dragover', (event) => {
      if (carriesFiles(event)) event.preventDefault();
    }),
    listen(window, 'drop', (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      show(-inside);
      if (event.dataTransfer) services.openDropped(droppedFiles(event.dataTransfer));
    }),
    () => {
      landing.remove();
    },
  );
};
