import { textButton } from '../widgets/button';
import { el, setAttribute, setText, setVariable } from '../widgets/dom';
import type { InfoCard, CardContent } from '../widgets/info-card';
import { surface, token } from '../widgets/lane-canvas';
import type { Mark } from './quality-marks';
import type { MeasureRow } from '../widgets/info-card';
import type { Span } from '../store/time-scale';

/** A mark with its label and the content of its info card. */
interface LabelledMark {
  readonly mark: Mark;
  readonly label: string;
  readonly card: CardContent;
}

/** What a lane shows. */
export interface LaneContent {
  readonly value: string;
  readonly sentence: string;
  /** Shown in the lane's card, with the sentence below where `sentenceInCard` is set. */
  readonly measures: readonly MeasureRow[];
  readonly sentenceInCard: boolean;
  /** Severity per frame (1 is the limit of what is acceptable), in one row or several above each other. */
  readonly rows: readonly Float32Array[];
  readonly fps: number;
  readonly marks: readonly LabelledMark[];
  /** The part of the dance that is shown, seconds. */
  readonly shown: Span;
}

export interface QualityLane {
  readonly label: HTMLElement;
  readonly lane: HTMLElement;
  readonly draw: (content: LaneContent) => void;
  readonly setStale: (stale: boolean) => void;
}

/** Width of one cell of the heat map, CSS pixels. */
const CELL_WIDTH = 3;
/** Opacity of a cell just below the limit, just above it, and from twice the limit on. */
const [BELOW_LIMIT, ABOVE_LIMIT, FULL] = [0.36, 0.5, 1];

/** One lane of the strip: its name and number, a heat map along time, and numbered marks to click. */
export function createQualityLane(
  name: string,
  className: string,
  onMark: (mark: Mark) => void,
  card: InfoCard,
): QualityLane {
  const value = el('b');
  const label = el(
    'button',
    { class: `lane-label quality ${className}`, attributes: { type: 'button' } },
    name,
    value,
  );
  const canvas = el('canvas', { attributes: { role: 'img', 'aria-label': `${name}: not measured yet` } });
  const flags = el('div', { class: 'flags' });
  const lane = el('div', { class: `lane quality ${className}` }, canvas, flags);
  /** By index of the mark: when marks change, the buttons stay, and with them the focus. */
  const buttons: { readonly flag: HTMLButtonElement; mark: Mark }[] = [];
  const button = (index: number, mark: Mark): HTMLButtonElement => {
    const known = buttons[index];
    if (known) {
      known.mark = mark;
      return known.flag;
    }
    const flag = textButton('flag', '', () => {
      onMark(made.mark);
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
    draw: (content) => {
      setText(value, content.value);
      const { measures, sentenceInCard, sentence } = content;
      card.set(label, { title: name, aside: '', rows: measures, text: sentenceInCard ? sentence : '' });
      canvas.setAttribute('aria-label', `${name} ${content.value}: ${content.sentence}`);
      drawHeatMap(canvas, content);
      const { from, to } = content.shown;
      content.marks.forEach(({ mark, label: markLabel, card: markCard }, index) => {
        const flag = button(index, mark);
        const at = (mark.moment.frame / content.fps - from) / Math.max(1e-9, to - from);
        flag.hidden = at < 0 || at > 1;
        setText(flag, String(mark.rank));
        setAttribute(flag, 'aria-label', `${mark.rank}. ${markLabel}`);
        setVariable(flag, '--at', at);
        card.set(flag, { ...markCard, title: `${mark.rank}. ${markCard.title}` });
      });
      for (const { flag } of buttons.splice(content.marks.length)) flag.remove();
    },
  };
}

/** Draws the heat map: neutral up to the limit, in the warning colour above it; a cell shows its worst frame. */
function drawHeatMap(canvas: HTMLCanvasElement, { rows, fps, shown }: LaneContent): void {
  const on = surface(canvas);
  if (!on || shown.to <= shown.from) return;
  const { context, width, height } = on;
  const [neutral, attention] = [token(canvas, '--text-3'), token(canvas, '--attention')];
  const rowHeight = height / Math.max(1, rows.length);
  const frameAt = (x: number): number => (shown.from + (x / width) * (shown.to - shown.from)) * fps;
  rows.forEach((row, index) => {
    for (let x = 0; x < width; x += CELL_WIDTH) {
      const first = Math.max(0, Math.floor(frameAt(x)));
      const last = Math.max(first + 1, Math.floor(frameAt(x + CELL_WIDTH)));
      let max = 0;
      for (let frame = first; frame < Math.min(last, row.length); frame++) {
        if (row[frame]! > max) max = row[frame]!;
      }
      if (max === 0) continue;
      context.fillStyle = max > 1 ? attention : neutral;
      context.globalAlpha =
        max > 1 ? ABOVE_LIMIT + (FULL - ABOVE_LIMIT) * Math.min(1, max - 1) : BELOW_LIMIT * max;
      // One pixel stays free between rows.
      context.fillRect(
        x,
        index * rowHeight,
        Math.min(CELL_WIDTH, width - x),
        rowHeight - (index + 1 < rows.length ? 1 : 0),
      );
    }
  });
  context.globalAlpha = 1;
}
