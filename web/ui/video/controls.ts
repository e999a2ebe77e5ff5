import type { VideoMotion, WorldOptions } from '../../video/client';
import { el, setText } from '../widgets/dom';

export interface Controls {
  readonly root: HTMLElement;
  /** @param span all of the video, seconds; a part of it that was chosen stays when the video is read again */
  readonly setSpan: (span: Span) => void;
  /** @param used the part that is used while none is chosen, seconds; null is all of the video */
  readonly setUsed: (used: Span | null) => void;
  /** @param options as they were set for an earlier motion, which is shown again */
  readonly setOptions: (options: WorldOptions) => void;
  /** @param camera where it was, as the motion has it */
  readonly setCamera: (camera: VideoMotion['camera']) => void;
}

interface Span {
  readonly start: number;
  readonly end: number;
}

/** Time after the last change before the motion is made anew. */
const WAIT_MS = 350;

/** Heights of dancers, centimetres. */
const HEIGHTS = { min: 100, max: 230 };

/** Focal lengths of cameras, relative to the longer side of their pictures. */
const FOCAL = { min: 0.3, max: 6 };

/** Corrections of a motion from a video: height of the dancer, distance of the camera, and the part that is used. */
export function createControls(change: (options: Partial<WorldOptions>) => void): Controls {
  let all: Span | null = null;
  /** Whether the visitor has chosen a part. */
  let chosen = false;
  let camera: VideoMotion['camera'] | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const [from, to] = [start.valueAsNumber, end.valueAsNumber];
      const trim = chosen ? { start: from, end: to } : null;
      const tall = height.valueAsNumber / 100;
      const focal = focalFor(distance.valueAsNumber);
      const wrong = whyNot(from >= to, height.validity);
      setText(problem, wrong ?? '');
      if ([from, to, tall, focal].every(Number.isFinite) && wrong === null)
        change({ height: tall, focal, trim });
    }, WAIT_MS);
  };
  /** The lens that sees the dancer as large from this distance. */
  const focalFor = (metres: number): number => {
    if (!camera) return NaN;
    if (metres === rounded(camera.distance)) return camera.focal;
    return Math.min(FOCAL.max, Math.max(FOCAL.min, (camera.focal * metres) / camera.distance));
  };
  const number = (id: string, min: number, max: number, step: number, value: number): HTMLInputElement =>
    el('input', { attributes: { type: 'number', id, min, max, step, value }, on: { change: later } });
  const height = number('video-height', HEIGHTS.min, HEIGHTS.max, 1, 170);
  const distance = number('video-distance', 0.5, 30, 0.1, 0);
  const start = number('video-start', 0, 600, 0.1, 0);
  const end = number('video-end', 0, 600, 0.1, 0);
  for (const input of [start, end]) input.addEventListener('change', () => (chosen = true));
  const problem = el('p', { class: 'status', attributes: { 'aria-live': 'polite' } });
  const row = (label: string, unit: string, input: HTMLInputElement): HTMLElement =>
    el('label', { attributes: { for: input.id } }, label, input, el('span', { text: unit }));
  const root = el(
    'details',
    {
      on: {
        toggle: () => {
          root.scrollIntoView({ block: 'nearest' });
        },
      },
    },
    el('summary', { text: 'Correct the motion' }),
    row('Height of the dancer', 'cm', height),
    row('Distance of the camera', 'm', distance),
    row('Use from', 's', start),
    row('Use to', 's', end),
    problem,
  );
  const showUsed = (span: Span, used: Span | null): void => {
    // Inwards, so that no picture beyond a cut is in it.
    start.value = String(
      used && used.start > span.start + 0.1 ? Math.ceil(used.start * 10) / 10 : span.start,
    );
    end.value = String(used && used.end < span.end - 0.1 ? Math.floor(used.end * 10) / 10 : span.end);
  };
  return {
    root,
    setSpan: (span) => {
      if (all) return;
      all = { start: Math.floor(span.start * 10) / 10, end: Math.ceil(span.end * 10) / 10 };
      showUsed(all, null);
    },
    setUsed: (used) => {
      if (all && !chosen) showUsed(all, used);
    },
    setOptions: ({ height: tall, trim }) => {
      clearTimeout(timer);
      height.value = String(Math.round(100 * tall));
      chosen = trim !== null;
      if (trim) [start.valueAsNumber, end.valueAsNumber] = [trim.start, trim.end];
    },
    setCamera: (found) => {
      camera = found;
      distance.value = String(rounded(found.distance));
    },
  };
}

/** In tenths of a metre, as the control has it. */
function rounded(metres: number): number {
  return Math.round(10 * metres) / 10;
}

/** Why nothing is changed, in a sentence; null where numbers can be used or are missing. */
function whyNot(isReversed: boolean, { rangeUnderflow, rangeOverflow }: ValidityState): string | null {
  if (rangeUnderflow || rangeOverflow)
    return `The height has to be between ${HEIGHTS.min} and ${HEIGHTS.max} cm: nothing was changed.`;
  return isReversed ? 'The beginning has to lie before the end: nothing was changed.' : null;
}
