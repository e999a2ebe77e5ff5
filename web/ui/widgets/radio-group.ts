import { el } from './dom';

/** A row of buttons of which one is chosen; arrow keys move the choice. */
interface RadioGroup<T extends string | number> {
  readonly element: HTMLElement;
  /** Shows which one is chosen. */
  readonly show: (value: T) => void;
}

/** To the next choice or the one before, by key. */
export const ARROW_STEPS: Readonly<Record<string, 1 | -1>> = {
  ArrowRight: 1,
  ArrowDown: 1,
  ArrowLeft: -1,
  ArrowUp: -1,
};

/** @param choose called with the visitor's choice; the group changes only by `show` */
export function radioGroup<T extends string | number>(
  label: string,
  options: readonly (readonly [T, string])[],
  choose: (value: T) => void,
): RadioGroup<T> {
  const buttons = options.map(([value, text], index) =>
    el('button', {
      class: 'btn',
      text,
      attributes: { type: 'button', role: 'radio' },
      on: {
        click: () => {
          choose(value);
        },
        keydown: (event) => {
          const move = ARROW_STEPS[event.key];
          if (move === undefined) return;
          event.preventDefault();
          event.stopPropagation();
          const next = (index + move + options.length) % options.length;
          choose(options[next]?.[0] ?? value);
          buttons[next]?.focus();
        },
      },
    }),
  );
  return {
    element: el(
      'div',
      { class: 'group', attributes: { role: 'radiogroup', 'aria-label': label } },
      ...buttons,
    ),
    show: (shown) => {
      options.forEach(([value], index) => {
        buttons[index]?.setAttribute('aria-checked', String(value === shown));
        buttons[index]?.setAttribute('tabindex', value === shown ? '0' : '-1');
      });
    },
  };
}
