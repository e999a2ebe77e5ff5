import { el, setVariable } from './dom';

/** A line that fills as something is being done. */
interface Meter {
  readonly element: HTMLElement;
  /** @param share that is done, 0 to 1 */
  readonly show: (share: number) => void;
}

export function createMeter(label: string): Meter {
  const fill = el('i');
  const attributes = { role: 'progressbar', 'aria-label': label, 'aria-valuemin': 0, 'aria-valuemax': 100 };
  const element = el('span', { class: 'meter', attributes }, fill);
  return {
    element,
    show: (share) => {
      setVariable(fill, '--part', share);
      element.setAttribute('aria-valuenow', String(Math.round(100 * share)));
    },
  };
}
