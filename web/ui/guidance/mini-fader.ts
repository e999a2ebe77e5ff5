import { el, setText, setVariable } from '../widgets/dom';
import { type FaderEvents, type FaderRange, connectFaderInput } from '../widgets/fader';

export interface MiniFader {
  readonly root: HTMLElement;
  /** Sets range and value; null disables it. */
  readonly show: (range: FaderRange | null, value: number) => void;
}

/** Share of the range above which the number is on the other side of the handle. */
const HIGH_SHARE = 0.7;

/**
 * A small fader, as in a cell of the matrix. Its hint is in the tooltip only.
 * @param describe text of a value for screen readers
 */
export function createMiniFader(
  label: string,
  hint: string,
  on: FaderEvents,
  describe: (value: number, range: FaderRange) => string,
): MiniFader {
  const value = el('output');
  const input = el('input', {
    attributes: {
      type: 'range',
      'aria-label': label,
      title: `${hint} Double click for the default.`,
      disabled: true,
    },
  });
  connectFaderInput(input, on);
  const root = el('div', { class: 'mini' }, el('span', { class: 'fill' }), value, input);
  return {
    root,
    show: (range, current) => {
      input.disabled = range === null;
      setText(value, range ? current.toFixed(2) : '');
      if (!range) return;
      input.min = String(range.min);
      input.max = String(range.max);
      input.step = String(range.step);
      if (input.valueAsNumber !== current) input.value = String(current);
      input.setAttribute('aria-valuetext', describe(current, range));
      const share = (current - range.min) / (range.max - range.min);
      setVariable(root, '--v', share);
      root.classList.toggle('high', share > HIGH_SHARE);
    },
  };
}
