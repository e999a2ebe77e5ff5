/** Answers and summary as tables (RFC 4180, with the first line for the titles). */
import Papa from 'papaparse';
import { AppError } from '../../common/error';
import { type Answer, CRITERIA, preferred } from './answers';
import type { Comparison } from './summary';

const TITLES = [
  'participant',
  'set',
  'seed',
  'pair',
  'duet',
  'left',
  'right',
  'criterion',
  'score',
  'preferred',
  'seconds',
] as const;
/** Largest number of lines that are read. */
const MAX_LINES = 100_000;

type Cell = string | number;

/** Programs take a text that begins with one of =, +, - and @ for a formula; an apostrophe before it keeps it a text. */
const table = (fields: string[], data: Cell[][]): string =>
  `${Papa.unparse({ fields, data }, { escapeFormulae: true })}\r\n`;

/** One line an answer. */
export function answersCsv(answers: readonly Answer[]): string {
  const rows = answers.map((answer): Cell[] => [
    answer.participant,
    answer.set,
    answer.seed,
    answer.pair,
    answer.duet,
    answer.left,
    answer.right,
    answer.criterion,
    answer.score,
    preferred(answer) ?? 'none',
    Math.round(answer.seconds * 10) / 10,
  ]);
  return table([...TITLES], rows);
}

/** A cell as a number; an empty one is none. */
const numberIn = (cell: string): number => (cell.trim() === '' ? NaN : Number(cell));

const round = (value: number): number => Math.round(value * 1e4) / 1e4;

/** One line for every two methods and criterion. */
export function summaryCsv(comparisons: readonly Comparison[]): string {
  const titles = ['method', 'against', 'criterion', 'answers', 'wins', 'equal', 'losses'];
  const rows = comparisons.map((one): Cell[] => [
    ...[one.method, one.against, one.criterion, one.answers, one.wins, one.equal, one.losses],
    ...[one.rate, ...one.interval, one.mean].map(round),
  ]);
  return table([...titles, 'win_rate', 'low_95', 'high_95', 'mean_score'], rows);
}

function refused(what: string): AppError {
  return new AppError(
    'not-answers',
    `This is not a file of saved answers: ${what}.`,
    'Choose files that this page has saved as “Answers”.',
  );
}

/**
 * Reads what `answersCsv` wrote.
 * @throws {AppError} `not-answers`, with the line
 */
export function readAnswers(text: string): Answer[] {
  const { data, errors, meta } = Papa.parse<Record<(typeof TITLES)[number], string>>(text, {
    header: true,
    delimiter: ',',
    skipEmptyLines: true,
    transform: (cell) => cell.replace(/^'(?=[=+\-@\t\r])/, ''),
  });
  if (meta.fields?.join() !== TITLES.join()) throw refused('the first line does not name their columns');
  if (errors[0]) throw refused(`line ${(errors[0].row ?? 0) + 2} is damaged (${errors[0].message})`);
  if (data.length > MAX_LINES) throw refused(`there are more than ${MAX_LINES} lines`);
  return data.map(({ participant, set, duet, left, right, criterion, ...row }, i) => {
    const known = CRITERIA.find(({ id }) => id === criterion)?.id;
    if (!known) throw refused(`line ${i + 2} has an unknown question`);
    const numbers = {
      seed: numberIn(row.seed),
      pair: numberIn(row.pair),
      score: numberIn(row.score),
      seconds: numberIn(row.seconds),
    };
    const { score } = numbers;
    if (!Object.values(numbers).every(Number.isFinite) || !Number.isInteger(score) || Math.abs(score) > 2)
      throw refused(`line ${i + 2} has a number out of range`);
    return { participant, set, duet, left, right, criterion: known, ...numbers };
  });
}
