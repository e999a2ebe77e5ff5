import { el, setVariable } from '../widgets/dom';
import { clockTime } from '../store/format';
import type { AppState, Job } from '../store/state';
import type { Span, TimeScale } from '../store/time-scale';
import { danceFps } from '../store/selectors';

/** The blocks in which the model makes a dance, under its curve, each filled as far as a new reaction is made. */
interface BlockRow {
  readonly root: HTMLElement;
  /** Places the blocks. */
  readonly draw: (state: AppState, scale: TimeScale) => void;
  /** Shows the progress of the job. */
  readonly fill: (state: AppState) => void;
}

export function createBlockRow(): BlockRow {
  const root = el('div', { class: 'blocks' });
  let blocks: Span[] = [];
  let cells: HTMLElement[] = [];

  const fill = ({ job }: AppState): void => {
    cells.forEach((cell, index) => {
      const block = blocks[index];
      if (!block) return;
      setVariable(cell, '--done', doneShare(block, blocks, job));
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
      const next = blocksOf(frames, length);
      if (next.length !== blocks.length || next.length === 0) {
        const count = Math.max(1, next.length);
        cells = Array.from({ length: count }, () => el('div', { class: 'block' }, el('div', { class: 'p' })));
        root.replaceChildren(...cells);
      }
      blocks = next;
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

/**
 * The blocks of a dance, frames; the last one may be short.
 * @param length of a block, frames
 */
export function blocksOf(frames: number, length: number): Span[] {
  if (frames <= 0 || length <= 0) return [];
  return Array.from({ length: Math.ceil(frames / length) }, (_, index) => ({
    from: index * length,
    to: Math.min(frames, (index + 1) * length),
  }));
}

/** The share of a block that is made, 0 to 1, estimated as if blocks were made one after the other. */
export function doneShare(block: Span, blocks: readonly Span[], job: Job | null): number {
  if (!job) return 0;
  const frames = blocks.at(-1)?.to ?? 0;
  const done = (job.fraction * frames - block.from) / (block.to - block.from);
  return Math.min(1, Math.max(0, done));
}
