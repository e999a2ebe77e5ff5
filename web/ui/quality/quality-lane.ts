import { el, setAttribute, setText, setVariable } from '../widgets/dom';
import type { CardContent, InfoCard } from '../widgets/info-card';
import { surface, token } from '../widgets/lane-canvas';
import type { Mark } from './quality-marks';
import type { MeasureRow } from '../widgets/info-card';

/** The part of the dance that the lanes show, seconds. */
export interface Shown {
  readonly from: number;
  readonly to: number;
}

/** A mark with its name and what there is to explain about it. */
export interface MarkWords {
  readonly mark: Mark;
  readonly words: string;
  readonly explained: CardContent;
}

/** What a lane shows. */
export interface LanePicture {
  readonly value: string;
  readonly sentence: string;
  /** What the lane's card shows; the sentence stands below it where `told` says so. */
  readonly measures: readonly MeasureRow[];
  readonly told: boolean;
  /** Concern per frame, one row or several above each other. */
  readonly rows: readonly Float32Array[];
  readonly fps: number;
  readonly marks: readonly MarkWords[];
  readonly shown: Shown;
}

export interface QualityLane {
  readonly label: HTMLElement;
  readonly lane: HTMLElement;
  readonly draw: (picture: LanePicture) => void;
  readonly setStale: (stale: boolean) => void;
}

/** Width of one cell of the heat, CSS pixels. */
const CELL = 3;
/** Opacities of a cell: at the limit from below, just beyond it, and where it is bad. */
const TINT = 0.36;
const BEYOND = 0.5;
const FULL = 1;

/** One row of the strip: its name and number, heat along time, and marks to click. */
export function createQualityLane(
  name: string,
  className: string,
  onMark: (mark: Mark) => void,
  infoCard: InfoCard,
): QualityLane {
  const value = el('b');
  const label = el('button', { class: `lab q ${className}`, attributes: { type: 'button' } }, name, value);
  const canvas = el('canvas', { attributes: { role: 'img', 'aria-label': `${name}: not measured yet` } });
  const flags = el('div', { class: 'flags' });
  const lane = el('div', { class: `lane q ${className}` }, canvas, flags);
  /** By place in the list: a mark that only moves stays the same button, with its focus. */
  const buttons: { readonly flag: HTMLButtonElement; mark: Mark }[] = [];
  const button = (index: number, mark: Mark): HTMLButtonElement => {
    const known = buttons[index];
    if (known) {
      known.mark = mark;
      return known.flag;
    }
    const flag = el('button', {
      class: 'flag',
      attributes: { type: 'button' },
      on: {
        click: () => {
          onMark(made.mark);
        },
      },
    });
    const made = { flag, mark };
    buttons.push(made);
    flags.append(flag);
    return flag;
  };
  return {
    label,
    lane,
    setStale: (stale) => {
      lane.classList.toggle('stale', stale);
      label.classList.toggle('stale', stale);
    },
    draw: (picture) => {
      setText(value, picture.value);
      const { measures, told, sentence } = picture;
      infoCard.set(label, { title: name, aside: '', rows: measures, text: told ? sentence : '' });
      canvas.setAttribute('aria-label', `${name} ${picture.value}: ${picture.sentence}`);
      drawHeat(canvas, picture);
      const { from, to } = picture.shown;
      picture.marks.forEach(({ mark, words, explained }, index) => {
        const flag = button(index, mark);
        const at = (mark.moment.frame / picture.fps - from) / Math.max(1e-9, to - from);
        flag.hidden = at < 0 || at > 1;
        setText(flag, String(mark.rank));
        setAttribute(flag, 'aria-label', `${mark.rank}. ${words}`);
        setVariable(flag, '--at', at);
        infoCard.set(flag, { ...explained, title: `${mark.rank}. ${explained.title}` });
      });
      for (const { flag } of buttons.splice(picture.marks.length)) flag.remove();
    },
  };
}

/** Neutral up to the limit, the colour of attention beyond it; a cell shows the worst of its frames. */
function drawHeat(canvas: HTMLCanvasElement, { rows, fps, shown }: LanePicture): void {
  const on = surface(canvas);
  if (!on || shown.to <= shown.from) return;
  const { context, width, height } = on;
  const [neutral, attention] = [token(canvas, '--text-3'), token(canvas, '--attention')];
  const tall = height / Math.max(1, rows.length);
  const frameAt = (x: number): number => (shown.from + (x / width) * (shown.to - shown.from)) * fps;
  rows.forEach((row, index) => {
    for (let x = 0; x < width; x += CELL) {
      const first = Math.max(0, Math.floor(frameAt(x)));
      const last = Math.max(first + 1, Math.floor(frameAt(x + CELL)));
      let most = 0;
      for (let frame = first; frame < Math.min(last, row.length); frame++) {
        if (row[frame]! > most) most = row[frame]!;
      }
      if (most === 0) continue;
      context.fillStyle = most > 1 ? attention : neutral;
      context.globalAlpha = most > 1 ? BEYOND + (FULL - BEYOND) * Math.min(1, most - 1) : TINT * most;
      // Rows keep a hairline between them.
      context.fillRect(x, index * tall, Math.min(CELL, width - x), tall - (index + 1 < rows.length ? 1 : 0));
    }
  });
  context.globalAlpha = 1;
}
