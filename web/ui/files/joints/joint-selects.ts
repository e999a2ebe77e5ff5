import type { Inspection } from '../../../motion/import/inspect';
import type { JointChoice } from '../../../motion/retarget/options';
import { type JointName, SMPL22 } from '../../../motion/skeleton/skeleton';
import { el } from '../../widgets/dom';

interface JointSelects {
  readonly element: HTMLElement;
  /** Draws the figure. */
  readonly show: () => void;
  readonly exchangeSides: () => void;
  /** All 22 choices where one of them was changed by hand; null else. */
  readonly changed: () => JointChoice | null;
}

const otherSide = (name: string): string =>
  name.replace(/^(left|right)/, (side) => (side === 'left' ? 'right' : 'left'));

/**
 * A list with the joint of the file for each of the 22.
 * @param draw is given the joints that are chosen, and the one whose row has the focus
 */
export function jointSelects(
  { joints, found }: Inspection,
  draw: (mapped: ReadonlySet<number>, marked: number | null) => void,
): JointSelects {
  const selects = new Map<JointName, HTMLSelectElement>();
  let focused: HTMLSelectElement | null = null;
  const valueOf = (select: HTMLSelectElement): number => (select.value === '' ? -1 : Number(select.value));
  const show = (): void => {
    const mapped = [...selects.values()].map(valueOf).filter((joint) => joint >= 0);
    draw(new Set(mapped), focused ? valueOf(focused) : null);
  };
  const rows = SMPL22.map((name) => {
    const select = el(
      'select',
      {
        on: {
          change: show,
          focus: () => {
            focused = select;
            show();
          },
        },
      },
      el('option', { text: 'estimated', attributes: { value: '' } }),
      ...joints.map((joint, index) => el('option', { text: joint.name, attributes: { value: index } })),
    );
    select.value = String(found[name] ?? '');
    selects.set(name, select);
    return el('label', {}, el('span', { text: name.replaceAll('_', ' ') }), select);
  });
  const before = [...selects.values()].map(({ value }) => value).join();
  return {
    element: el('div', { class: 'joints' }, ...rows),
    show,
    exchangeSides: () => {
      const values = new Map([...selects].map(([name, { value }]) => [name as string, value]));
      for (const [name, select] of selects) select.value = values.get(otherSide(name)) ?? '';
      show();
    },
    changed: () => {
      if ([...selects.values()].map(({ value }) => value).join() === before) return null;
      const choices = [...selects].map(([name, select]) => [name, joints[valueOf(select)]?.name ?? null]);
      return Object.fromEntries(choices) as JointChoice;
    },
  };
}
