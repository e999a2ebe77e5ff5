import { blocksOf, doneOf } from './blocks';
import { el, setVariable } from '../widgets/dom';
import { clockTime } from '../store/format';
import type { AppState } from '../store/state';
import type { Span, TimeScale } from '../store/time-scale';
import { danceFps } from '../store/selectors';

/** The reactor's blocks under its curve: where the model's blocks meet, and how far a new reaction has come. */
export interface BlockRow {
  readonly root: HTMLElement;
  /** Places the blocks. */
  readonly draw: (state: AppState, scale: TimeScale) => void;
  /** Fills what is done. */
  readonly fill: (state: AppState) => void;
}

/** A row without blocks. */
export function createBlockRow(): BlockRow {
  const root = el('div', { class: 'blocks' });
  let blocks: Span[] = [];
  let cells: HTMLElement[] = [];

  const fill = ({ job }: AppState): void => {
    cells.forEach((cell, index) => {
      const block = blocks[index];
      if (!block) return;
      const { from, to } = doneOf(block, blocks, job);
      setVariable(cell, '--done-from', from);
      setVariable(cell, '--done', to - from);
    });
  };
  return {
    root,
    fill,
    draw: (state, scale) => {
      const { leader, manifest } = state;
      const fps = danceFps(state);
      const frames = leader?.file.clip.frames ?? 0;
      const length = manifest ? manifest.latent.block * manifest.latent.stride : frames;
      const coming = blocksOf(frames, length);
      if (coming.length !== blocks.length || coming.length === 0) {
        const count = Math.max(1, coming.length);
        cells = Array.from({ length: count }, () => el('div', { class: 'blk' }, el('div', { class: 'p' })));
        root.replaceChildren(...cells);
      }
      blocks = coming;
      cells.forEach((cell, index) => {
        const block = blocks[index];
        const left = block ? scale.x(block.from / fps) : 0;
        const right = block ? scale.x(block.to / fps) : scale.width;
        setVariable(cell, '--from', scale.width > 0 ? left / scale.width : 0);
        setVariable(cell, '--span', scale.width > 0 ? (right - left) / scale.width : 1);
        cell.title = block
          ? `Block ${index + 1} of ${blocks.length}: ${clockTime(block.from / fps)} to ${clockTime(block.to / fps)}`
          : '';
      });
      fill(state);
    },
  };
}
