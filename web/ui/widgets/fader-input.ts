/** The native range input of a fader, over a drawn track. */
import { setVariable } from './dom';

export interface FaderEvents {
  readonly change: (value: number) => void;
  /** @param moved whether the first click of the double click has moved it */
  readonly reset: (moved: boolean) => void;
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

/** Share of the way from the lower to the upper end of a range. */
export function shareOf(value: number, { min, max }: FaderRange): number {
  return (value - min) / (max - min);
}

/** Share of the range above which a number is on the other side of the handle. */
const HIGH_SHARE = 0.7;

/** Sets an input's range and value, and for the style sheets the shares of value (`--v`) and default (`--default`). */
export function showValue(
  root: HTMLElement,
  input: HTMLInputElement,
  range: FaderRange,
  value: number,
): void {
  input.min = String(range.min);
  input.max = String(range.max);
  input.step = String(range.step);
  if (input.valueAsNumber !== value) input.value = String(value);
  setVariable(root, '--v', shareOf(value, range));
  root.classList.toggle('high', shareOf(value, range) > HIGH_SHARE);
  setVariable(root, '--default', shareOf(range.default, range));
}

/** Connects a range input to callbacks: drag, keys, double click for the default, Shift for a finer drag. */
export function connectFaderInput(
  input: HTMLInputElement,
  { change, reset, grab, release }: FaderEvents,
): void {
  input.addEventListener('pointerdown', ({ button }) => {
    if (button === 0) grab?.();
  });
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
    input.addEventListener(type, () => release?.());
  let moved = false;
  input.addEventListener('mousedown', ({ detail }) => {
    if (detail === 1) moved = false;
  });
  input.addEventListener('input', () => {
    moved = true;
    change(input.valueAsNumber);
  });
  input.addEventListener('dblclick', () => {
    reset(moved);
  });
  dragFinely(input, change);
}

/** With Shift held the value moves a tenth as far as the pointer. */
function dragFinely(input: HTMLInputElement, change: (value: number) => void): void {
  let from: { x: number; value: number } | null = null;
  input.addEventListener('pointerdown', (event) => {
    if (!event.shiftKey || event.button !== 0 || input.disabled) return;
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
