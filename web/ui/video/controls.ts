import { DEFAULT_FOCAL, type WorldOptions } from '../../video/client';
import { el } from '../widgets/dom';

export interface Controls {
  readonly root: HTMLElement;
  /** @param seconds length of the video */
  readonly setDuration: (seconds: number) => void;
}

/** Time after the last change before the motion is made anew. */
const WAIT_MS = 350;

/** Corrections of a motion from a video: height, focal length of the camera, and the part that is used. */
export function createControls(change: (options: Partial<WorldOptions>) => void): Controls {
  let duration = 0;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const [from, to] = [start.valueAsNumber, end.valueAsNumber];
      const trim = from > 0 || to < duration ? { start: from, end: to } : null;
      const [tall, lens] = [height.valueAsNumber / 100, focal.valueAsNumber];
      if ([from, to, tall, lens].every(Number.isFinite) && from < to)
        change({ height: tall, focal: lens, trim });
    }, WAIT_MS);
  };
  const number = (id: string, min: number, max: number, step: number, value: number): HTMLInputElement =>
    el('input', { attributes: { type: 'number', id, min, max, step, value }, on: { change: later } });
  const height = number('video-height', 100, 230, 1, 170);
  const focal = number('video-focal', 0.5, 3, 0.05, DEFAULT_FOCAL);
  const start = number('video-start', 0, 600, 0.1, 0);
  const end = number('video-end', 0, 600, 0.1, 0);
  const row = (label: string, unit: string, input: HTMLInputElement): HTMLElement =>
    el('label', { attributes: { for: input.id } }, label, input, el('span', { text: unit }));
  const root = el(
    'details',
    {},
    el('summary', { text: 'Correct the motion' }),
    row('Height of the dancer', 'cm', height),
    row('Lens: above 0.9 for zoom, below for wide angle', '', focal),
    row('Use from', 's', start),
    row('Use to', 's', end),
  );
  return {
    root,
    setDuration: (seconds) => {
      duration = Math.ceil(seconds * 10) / 10;
      end.value = String(duration);
    },
  };
}
