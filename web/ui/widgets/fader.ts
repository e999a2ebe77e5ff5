import { el, setText, setVariable } from './dom';
import { drawing } from './icons';
import type { Layer } from '../store/reaction';

export interface FaderEvents {
  readonly change: (value: number) => void;
  readonly reset: () => void;
  /** The pointer has grabbed it; all changes until its release belong together. */
  readonly grab?: () => void;
  readonly release?: () => void;
}

/** A fader's range, from the manifest. */
export interface FaderRange {
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly default: number;
}

interface Fader {
  readonly root: HTMLElement;
  readonly input: HTMLInputElement;
  /** Sets range and value, the mean where the body parts are mixed; without a range it is disabled. */
  readonly show: (range: FaderRange | null, value: number, mixed?: boolean) => void;
  /** Outlines it while its change is being applied. */
  readonly setApplying: (applying: boolean) => void;
}

/** What the dance is towards the lower and the upper end, as measured (docs/results.md). */
const LAYER_ENDS: Readonly<Record<Layer, readonly [low: string, high: string]>> = {
  coarse: ['looser', 'larger'],
  fine: ['softer', 'sharper'],
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
 * with Shift is ten times finer; a double click resets to the default.
 */
export function createFader(
  layer: Layer,
  name: string,
  hint: string,
  on: FaderEvents,
): Fader {
  const hintId = `hint-${layer}`;
  const value = el('output', { class: 'val' });
  const mix = el('small', { class: 'mix', text: 'mixed' });
  mix.hidden = true;
  const well = el(
    'span',
    { class: 'well' },
    el('span', { class: 'fill' }),
    el('span', { class: 'name', text: name }),
    drawing(`0 0 ${CURVE_SIZE.width} ${CURVE_SIZE.height}`, 'w', [[curvePath(layer)]]),
    mix,
    value,
  );
  const input = el('input', {
    attributes: {
      type: 'range',
      'aria-label': `${name} guidance`,
      'aria-describedby': hintId,
      title: `${hint} Double click for the default.`,
      disabled: true,
    },
  });
  connectFaderInput(input, on);
  const scale = el('div', { class: 'scale', attributes: { 'aria-hidden': 'true' } });
  const root = el(
    'div',
    { class: 'fader' },
    well,
    input,
    scale,
    el('span', { class: 'hint', text: hint, attributes: { id: hintId } }),
  );

  let drawn: FaderRange | null = null;
  return {
    root,
    input,
    show: (range, current, mixed = false) => {
      input.disabled = range === null;
      setText(value, range ? current.toFixed(2) : '');
      if (!range) return;
      if (range !== drawn) {
        drawn = range;
        input.min = String(range.min);
        input.max = String(range.max);
        input.step = String(range.step);
        scale.replaceChildren(...marks(range, LAYER_ENDS[layer]));
      }
      if (input.valueAsNumber !== current) input.value = String(current);
      mix.hidden = !mixed;
      input.setAttribute('aria-valuetext', valueText(current, range, layer, mixed));
      setVariable(root, '--v', (current - range.min) / (range.max - range.min));
    },
    setApplying: (applying) => {
      root.classList.toggle('applying', applying);
    },
  };
}

/** A mark at each end with its word, and one at the default. */
function marks({ min, max, default: preset }: FaderRange, [low, high]: readonly [string, string]): HTMLElement[] {
  const mark = (at: number, text: string): HTMLElement => {
    const element = el('span', { text });
    setVariable(element, '--at', (at - min) / (max - min));
    return element;
  };
  return [mark(min, low), ...(preset > min && preset < max ? [mark(preset, 'default')] : []), mark(max, high)];
}

/** Text of a value for screen readers. */
export function valueText(
  value: number,
  { min, max, default: preset }: FaderRange,
  layer: Layer,
  mixed = false,
): string {
  const [low, high] = LAYER_ENDS[layer];
  const way = value < preset ? (preset - value) / (preset - min) : (value - preset) / (max - preset);
  const word = value < preset ? low : high;
  const amount = way < 0.35 ? 'a little ' : way > 0.7 ? 'much ' : '';
  const text = value === preset ? `${value.toFixed(2)}, default` : `${value.toFixed(2)}, ${amount}${word}`;
  return mixed ? `${text}, on average: the body parts are mixed` : text;
}

/** Connects a range input to callbacks: drag, keys, double click for the default, Shift for a finer drag. */
export function connectFaderInput(
  input: HTMLInputElement,
  { change, reset, grab, release }: FaderEvents,
): void {
  input.addEventListener('pointerdown', () => grab?.());
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
    input.addEventListener(type, () => release?.());
  input.addEventListener('input', () => {
    change(input.valueAsNumber);
  });
  input.addEventListener('dblclick', reset);
  dragFinely(input, change);
}

/** With Shift held the value moves a tenth as far as the pointer. */
function dragFinely(input: HTMLInputElement, change: (value: number) => void): void {
  let from: { x: number; value: number } | null = null;
  input.addEventListener('pointerdown', (event) => {
    if (!event.shiftKey || input.disabled) return;
    event.preventDefault();
    input.focus();
    input.setPointerCapture(event.pointerId);
    from = { x: event.clientX, value: input.valueAsNumber };
  });
  input.addEventListener('pointermove', (event) => {
    if (!from) return;
    const range = Number(input.max) - Number(input.min);
    change(from.value + ((event.clientX - from.x) / input.clientWidth) * range * 0.1);
  });
  const stop = (): void => {
    from = null;
  };
  input.addEventListener('pointerup', stop);
  input.addEventListener('pointercancel', stop);
}
