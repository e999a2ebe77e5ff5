import { counted } from '../store/format';
import { textButton } from '../widgets/button';
import { el } from '../widgets/dom';
import { type Answer, CRITERIA } from './answers';
import { type Comparison, summarise } from './summary';

/** What can be done with the result. */
interface ResultActions {
  readonly saveAnswers: () => void;
  readonly saveSummary: () => void;
  readonly again: () => void;
}

/**
 * The end: how often each method was preferred, with intervals, and the files to save.
 * @param repeated how many more answers were left out because they are among these
 */
export function resultView(
  answers: readonly Answer[],
  repeated: number,
  reference: string | null,
  actions: ResultActions,
): HTMLElement {
  const participants = new Set(answers.map(({ participant, seed }) => `${participant} ${seed}`)).size;
  const comparisons = summarise(answers, reference);
  return el(
    'section',
    { class: 'result', attributes: { 'aria-label': 'Result' } },
    el('h1', { text: 'Thank you', attributes: { tabindex: -1 } }),
    el('p', {
      text: `${answers.length} answers of ${counted(participants, 'participant')}. A share is that of the answers that prefer the first method, “no difference” counting half; in brackets the 95 % interval of Wilson, which takes the answers as independent.`,
    }),
    repeated > 0 ? el('p', { text: `${repeated} more were there twice and count once.` }) : null,
    table(comparisons),
    el(
      'div',
      { class: 'study-actions' },
      textButton('btn primary', 'Save answers (CSV)', actions.saveAnswers),
      textButton('btn tint', 'Save summary (CSV)', actions.saveSummary),
      textButton('btn ghost', 'Next participant', actions.again),
    ),
  );
}

const percent = (share: number): string => String(Math.round(100 * share));

function table(comparisons: readonly Comparison[]): HTMLElement {
  const rows = new Map<string, Comparison[]>();
  for (const one of comparisons) {
    const key = `${one.method} over ${one.against}`;
    rows.set(key, [...(rows.get(key) ?? []), one]);
  }
  const cell = (list: readonly Comparison[], id: string): string => {
    const found = list.find(({ criterion }) => criterion === id);
    if (!found) return 'not asked';
    const [low, high] = found.interval.map(percent);
    return `${percent(found.rate)} % (${low!} to ${high!}), ${found.answers}`;
  };
  return el(
    'table',
    {},
    el(
      'thead',
      {},
      el(
        'tr',
        {},
        ...['Preferred', ...CRITERIA.map(({ id }) => id)].map((text) =>
          el('th', { text, attributes: { scope: 'col' } }),
        ),
      ),
    ),
    el(
      'tbody',
      {},
      ...[...rows].map(([name, list]) =>
        el(
          'tr',
          {},
          el('th', { text: name, attributes: { scope: 'row' } }),
          ...CRITERIA.map(({ id }) => el('td', { text: cell(list, id) })),
        ),
      ),
    ),
  );
}
