import { type Attributes, el } from './dom';
import { icon, type IconName } from './icons';

/** A button that shows an icon. `label` is what a screen reader says, `title` the tooltip. */
export function iconButton(
  className: string,
  name: IconName,
  { label, title }: { readonly label?: string; readonly title?: string },
  onClick: (event: MouseEvent) => void,
): HTMLButtonElement {
  return el(
    'button',
    { class: className, attributes: { type: 'button', 'aria-label': label, title }, on: { click: onClick } },
    icon(name),
  );
}

/** The button that closes a floating panel. */
export function closeButton(close: () => void): HTMLButtonElement {
  return iconButton('icon', 'close', { label: 'Close' }, close);
}

/** A button that shows words. */
export function textButton(
  className: string,
  text: string,
  onClick: (event: MouseEvent) => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  return el('button', {
    class: className,
    text,
    attributes: { type: 'button', ...attributes },
    on: { click: onClick },
  });
}
