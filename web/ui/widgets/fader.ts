import { el, setText, setVariable } from './dom';
import { connectFaderInput, type FaderEvents, type FaderRange, shareOf, showValue } from './fader-input';
import { drawing } from './icons';
import type { Layer } from '../store/reaction';

/** What a fader moves: the guidance of a layer, the guidance of the music, or the variety. */
export type Control = Layer | 'music' | 'variety';

/** How a fader is named. */
export interface FaderTexts {
  readonly name: string;
  /** Its name for screen readers. */
  readonly label: string;
  /** What it moves, in a few words. */
  readonly hint: string;
}

/** What is said beside the value. */
export type FaderNote = 'mixed' | 'no song' | null;

/** Id of a fader's input. */
export const faderId = (control: Control): string => `fader-${control}`;

interface Fader {
  readonly root: HTMLElement;
  /** Sets range and value, the mean where the body parts are mixed; without a range it is disabled. */
  readonly show: (range: FaderRange | null, value: number, note: FaderNote) => void;
  /** Outlines it while its change is being applied. */
  readonly setApplying: (applying: boolean) => void;
}

/** What the dance is at the lower and at the upper end, as measured (docs/results.md). */
const ENDS: Readonly<Record<Control, readonly [low: string, high: string]>> = {
  coarse: ['looser', 'larger'],
  fine: ['softer', 'sharper'],
  music: ['less song', 'more song'],
  variety: ['average', 'individual'],
};

/** Size of the drawn curve, in its own units. */
const CURVE_SIZE = { width: 112, height: 26 };

/** A picture of the layer: a slow wave for coarse, the same wave with ripples for fine. */
function curvePath(layer: Layer): string {
  const ripple = layer === 'fine' ? 4 : 0;
  const points: string[] = [];
  for (let x = 2; x <= CURVE_SIZE.width - 2; x += 0.6) {
    const slow = Math.sin((x - 2) / 14) * (layer === 'fine' ? 4.5 : 8);
    points.push(`${x.toFixed(1)} ${(CURVE_SIZE.height / 2 - slow - Math.sin(x / 1.65) * ripple).toFixed(1)}`);
  }
  return `M${points.join('L')}`;
}

/**
 * A native range input over a drawn track, so that keyboard, touch and screen readers work by themselves. Dragging
 * with Shift is ten times finer; a double click resets to the default. The faders of the layers are large and have a
 * picture of what they move.
 */
export function createFader(control: Control, { name, label, hint }: FaderTexts, on: FaderEvents): Fader {
  const hintId = `hint-${control}`;
  // The input says it already, in more words.
  const value = el('output', { class: 'val', attributes: { 'aria-live': 'off' } });
  const aside = el('small', { class: 'note' });
  const large = control === 'coarse' || control === 'fine';
  const well = el(
    'span',
    { class: 'well' },
    el('span', { class: 'fill' }),
    el('span', { class: 'name', text: name }),
    large ? drawing(`0 0 ${CURVE_SIZE.width} ${CURVE_SIZE.height}`, 'w', [[curvePath(control)]]) : null,
    aside,
    value,
  );
  const input = el('input', {
    attributes: {
      type: 'range',
      id: faderId(control),
      'aria-label': label,
      'aria-describedby': hintId,
      title: `${hint}. Double click for the default.`,
      disabled: true,
    },
  });
  connectFaderInput(input, on);
  const scale = el('div', { class: 'scale', attributes: { 'aria-hidden': 'true' } });
  const root = el(
    'div',
    { class: large ? 'fader' : 'fader small' },
    well,
    input,
    scale,
    el('span', { class: 'hint', text: hint, attributes: { id: hintId } }),
  );

  let drawn: FaderRange | null = null;
  return {
    root,
    show: (range, current, note) => {
      input.disabled = range === null;
      setText(value, range ? current.toFixed(2) : '');
      setText(aside, note ?? '');
      if (!range) return;
      if (range !== drawn) scale.replaceChildren(...marks(control, range, large ? 'default' : ''));
      drawn = range;
      showValue(root, input, range, current);
      const spoken = valueText(control, current, range);
      const mixed = note === 'mixed' ? ', on average: the body parts are mixed' : '';
      input.setAttribute('aria-valuetext', spoken + mixed);
    },
    setApplying: (applying) => {
      root.classList.toggle('applying', applying);
    },
  };
}

/** A mark at each end with its word, and one at the default. */
function marks(control: Control, range: FaderRange, defaultWord: string): HTMLElement[] {
  const [low, high] = ENDS[control];
  const mark = (at: number, text: string): HTMLElement => {
    const element = el('span', { text });
    setVariable(element, '--at', shareOf(at, range));
    return element;
  };
  const { min, max, default: preset } = range;
  const inside = preset > min && preset < max;
  return [mark(min, low), ...(inside ? [mark(preset, defaultWord)] : []), mark(max, high)];
}

/** Text of a value for screen readers: `0.50, towards larger`. */
export function valueText(
  control: Control,
  value: number,
  { min, max, default: preset }: FaderRange,
): string {
  if (value === preset) return `${value.toFixed(2)}, default`;
  const [low, high] = ENDS[control];
  const [word, end] = value < preset ? [low, min] : [high, max];
  const share = (value - preset) / (end - preset);
  const way =
    share === 1 ? '' : share > 0.7 ? 'far towards ' : share < 0.35 ? 'a little towards ' : 'towards ';
  return `${value.toFixed(2)}, ${way}${word}`;
}
