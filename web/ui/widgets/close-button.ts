import { el } from './dom';
import { icon } from './icons';

/** The button that closes a floating panel. */
export function closeButton(close: () => void): HTMLButtonElement {
  return el(
    'button',
    { class: 'icon', attributes: { type: 'button', 'aria-label': 'Close' }, on: { click: close } },
    icon('close'),
  );
}
