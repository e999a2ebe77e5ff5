import { el, setText } from '../widgets/dom';
import { connectFaderInput, type FaderEvents, type FaderRange, showValue } from '../widgets/fader-input';

export interface MiniFader {
  readonly root: HTMLElement;
  readonly show: (range: FaderRange, value: number) => void;
}

/**
 * The fader of a cell of the matrix. Its hint is in the tooltip only.
 * @param describe text of a value for screen readers
 */
export function createMiniFader(
  label: string,
  hint: string,
  on: FaderEvents,
  describe: (value: number, range: FaderRange) => string,
): MiniFader {
  // The input says it already, in more words.
  const value = el('output', { attributes: { 'aria-live': 'off' } });
  const input = el('input', {
    attributes: { type: 'range', 'aria-label': label, title: `${hint} Double click for the default.` },
  });
  connectFaderInput(input, on);
  const root = el('div', { class: 'mini' }, el('span', { class: 'fill' }), value, input);
  return {
    root,
    show: (range, current) => {
      setText(value, current.toFixed(2));
      showValue(root, input, range, current);
      input.setAttribute('aria-valuetext', describe(current, range));
    },
  };
}
