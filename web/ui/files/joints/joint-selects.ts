import { changedChoice, type ChosenJoints, sidesExchanged } from './joint-choice';
import type { Inspection } from '../../../motion/import/inspect';
import type { JointChoice } from '../../../motion/retarget/options';
import { type JointName, SMPL22 } from '../../../motion/skeleton/skeleton';
import { el, UNTRANSLATED } from '../../widgets/dom';

interface JointSelects {
  readonly element: HTMLElement;
  /** Draws the figure. */
  readonly show: () => void;
  readonly exchangeSides: () => void;
  /** All 22 choices where one of them was changed by hand; null else. */
  readonly changed: () => JointChoice | null;
}

/** The trunk, then the limbs with the left one of each pair before the right one, so that sides are columns. */
const ROWS = [...SMPL22].sort((a, b) => Number(isOfSide(a)) - Number(isOfSide(b)));

function isOfSide(name: JointName): boolean {
  return /^(left|right)_/.test(name);
}

const valueOf = (select: HTMLSelectElement): number | null =>
  select.value === '' ? null : Number(select.value);

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
  const chosen = (): ChosenJoints =>
    Object.fromEntries(
      [...selects].map(([name, select]) => [name, valueOf(select)]),
    ) as unknown as ChosenJoints;
  const show = (): void => {
    const mapped = Object.values(chosen()).filter((joint) => joint !== null);
    draw(new Set(mapped), focused && valueOf(focused));
  };
  const rows = ROWS.map((name) => {
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
      ...joints.map((joint, index) =>
        el('option', { text: joint.name, attributes: { value: index, ...UNTRANSLATED } }),
      ),
    );
    select.value = String(found[name] ?? '');
    selects.set(name, select);
    return el('label', {}, el('span', { text: name.replaceAll('_', ' ') }), select);
  });
  const before = chosen();
  return {
    element: el('div', { class: 'joints' }, ...rows),
    show,
    exchangeSides: () => {
      for (const [name, joint] of Object.entries(sidesExchanged(chosen())))
        selects.get(name as JointName)!.value = String(joint ?? '');
      show();
    },
    changed: () => changedChoice(before, chosen(), joints),
  };
}
