import type { Inspection } from '../../../motion/import/inspect';
import { ALL_UNITS, type AxisName, type UnitName, UP_AXES } from '../../../motion/retarget/axes-and-units';
import type { ImportOptions } from '../../../motion/retarget/options';
import { el } from '../../widgets/dom';

type Choice = readonly [value: string, text: string];

const AS_FOUND: Choice = ['', 'as found'];

function select(choices: readonly Choice[], value: string): HTMLSelectElement {
  const element = el(
    'select',
    {},
    ...choices.map(([key, text]) => el('option', { text, attributes: { value: key } })),
  );
  element.value = value;
  return element;
}

function number(
  value: number | undefined,
  limits: { min: number; max: number; step: number | 'any' },
): HTMLInputElement {
  const element = el('input', { attributes: { type: 'number', placeholder: 'as found', ...limits } });
  element.value = value === undefined ? '' : String(value);
  return element;
}

const numberOf = ({ value }: HTMLInputElement): number | undefined =>
  value === '' || !Number.isFinite(Number(value)) ? undefined : Number(value);

/** Controls of everything about a motion file that can be set by hand, but its joints. */
export function importControls(
  options: ImportOptions,
  inspection: Inspection | null,
): {
  readonly element: HTMLElement;
  /**
   * False where a number can't be used, such as one with a comma in a browser that takes points; the browser then says so
   * beside it.
   */
  readonly reportValidity: () => boolean;
  readonly options: () => ImportOptions;
} {
  const parts = inspection?.parts ?? [];
  const part = select(
    parts.map((name, index) => [String(index), name]),
    String(inspection?.part ?? ''),
  );
  const unit = select([AS_FOUND, ...ALL_UNITS.map(({ name }): Choice => [name, name])], options.unit ?? '');
  const up = select([AS_FOUND, ...UP_AXES.map(({ name }): Choice => [name, name])], options.up ?? '');
  const turn = select(
    [0, 90, 180, 270].map((angle): Choice => [
      String(angle),
      angle === 0 ? 'as found' : `turned by ${angle}°`,
    ]),
    String(options.turn ?? 0),
  );
  const floor = number(options.floor, { min: -10, max: 10, step: 0.001 });
  const fps = number(options.fps, { min: 5, max: 1000, step: 'any' });
  const row = (text: string, control: HTMLElement): HTMLElement =>
    el('label', {}, el('span', { text }), control);
  return {
    element: el(
      'div',
      { class: 'controls' },
      ...(parts.length > 1 ? [row('Clip or dancer', part)] : []),
      row('Unit', unit),
      row('Up axis', up),
      row('Facing', turn),
      row('Floor at, metres', floor),
      row('Frames per second', fps),
    ),
    reportValidity: () => [floor, fps].every((input) => input.reportValidity()),
    options: () => ({
      part: parts.length > 1 ? Number(part.value) : options.part,
      unit: unit.value === '' ? undefined : (unit.value as UnitName),
      up: up.value === '' ? undefined : (up.value as AxisName),
      turn: turn.value === '0' ? undefined : Number(turn.value),
      floor: numberOf(floor),
      fps: numberOf(fps),
    }),
  };
}
