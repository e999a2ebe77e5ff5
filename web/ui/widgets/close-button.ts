import { el } from './dom';
import { icon } from './icons';

/** The cross at the head of a floating card. */
export function closeButton(close: () => void): HTMLButtonElement {
  return el(
    'button',
    { class: 'icon', attributes: { type: 'button', 'aria-label': 'Close' }, on: { click: close } },
    icon('close'),
  );
}
