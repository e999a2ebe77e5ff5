import { type Attributes, el, setAttribute } from './dom';
import { icon, type IconName } from './icons';

type Click = (event: MouseEvent) => void;

/** Whether it is disabled and has kept the focus. */
const isHeld = (button: EventTarget | null): boolean =>
  button instanceof Element && button.getAttribute('aria-disabled') === 'true';

const unlessHeld =
  (onClick: Click): Click =>
  (event) => {
    if (!isHeld(event.currentTarget)) onClick(event);
  };

/** A button that shows an icon. `label` is what a screen reader says, `title` the tooltip. */
export function iconButton(
  className: string,
  name: IconName,
  { label, title }: { readonly label?: string; readonly title?: string },
  onClick: Click,
): HTMLButtonElement {
  const attributes = { type: 'button', 'aria-label': label, title };
  return el('button', { class: className, attributes, on: { click: unlessHeld(onClick) } }, icon(name));
}

/** The button that closes a floating panel. */
export function closeButton(close: () => void): HTMLButtonElement {
  return iconButton('icon', 'close', { label: 'Close' }, close);
}

/** A button that shows words. */
export function textButton(
  className: string,
  text: string,
  onClick: Click,
  attributes: Attributes = {},
): HTMLButtonElement {
  return el('button', {
    class: className,
    text,
    attributes: { type: 'button', ...attributes },
    on: { click: unlessHeld(onClick) },
  });
}

/**
 * Disables or enables a button that may have the focus, as it has after it was pressed. Browsers take the focus from a
 * disabled button, and whoever uses keys or a screen reader would be at the top of the page: while it has the focus it
 * is only said to be disabled, and does nothing.
 */
export function setDisabled(button: HTMLButtonElement, disabled: boolean): void {
  const held = disabled && button === document.activeElement;
  button.onblur = held
    ? () => {
        setDisabled(button, true);
      }
    : null;
  button.disabled = disabled && !held;
  setAttribute(button, 'aria-disabled', held && 'true');
}
