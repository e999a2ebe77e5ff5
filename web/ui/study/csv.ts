/** Answers and summary as tables (RFC 4180, with the first line for the titles). */
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

/** Programs take what begins with one of these for a formula; the apostrophe makes it a text. */
const FORMULA = /^[=+\-@\t\r]/;

function cellText(cell: Cell): string {
  if (typeof cell === 'number') return String(cell);
  const safe = FORMULA.test(cell) ? `'${cell}` : cell;
  return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

const table = (titles: readonly string[], rows: readonly (readonly Cell[])[]): string =>
  [titles, ...rows].map((row) => `${row.map(cellText).join(',')}\r\n`).join('');

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
  return table(TITLES, rows);
}

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
    `These are no answers of a study: ${what}.`,
    'Choose files that this page has saved as “Answers”.',
  );
}

/** The cells of a table. */
function cellsOf(text: string): string[][] {
  const rows: string[][] = [[]];
  const cell = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r\n|\n|\r|$)/y;
  while (cell.lastIndex < text.length) {
    const match = cell.exec(text);
    if (!match) throw refused(`line ${rows.length} is not closed`);
    const [, quoted, plain = '', end] = match;
    rows.at(-1)!.push(quoted?.replaceAll('""', '"') ?? plain);
    if (end !== ',') rows.push([]);
    if (rows.length > MAX_LINES) throw refused(`there are more than ${MAX_LINES} lines`);
  }
  return rows.filter((row) => row.length > 1 || (row[0] ?? '') !== '');
}

/**
 * Reads what `answersCsv` wrote.
 * @throws {AppError} `not-answers`, with the line
 */
export function readAnswers(text: string): Answer[] {
  const [titles, ...rows] = cellsOf(text.replace(/^\uFEFF/, ''));
  if (titles?.join() !== TITLES.join()) throw refused('the first line does not name their columns');
  return rows.map((row, i) => {
    if (row.length !== TITLES.length) throw refused(`line ${i + 2} has ${row.length} cells`);
    const [participant, set, seed, pair, duet, left, right, criterion, score, , seconds] = row.map((cell) =>
      /^'[=+\-@\t\r]/.test(cell) ? cell.slice(1) : cell,
    ) as [string, string, string, string, string, string, string, string, string, string, string];
    const known = CRITERIA.find(({ id }) => id === criterion)?.id;
    if (!known) throw refused(`line ${i + 2} asks for something else`);
    const numbers = {
      seed: Number(seed),
      pair: Number(pair),
      score: Number(score),
      seconds: Number(seconds),
    };
    const { score: value } = numbers;
    if (!Object.values(numbers).every(Number.isFinite) || !Number.isInteger(value) || Math.abs(value) > 2)
      throw refused(`line ${i + 2} has a number that is none of theirs`);
    return { participant, set, duet, left, right, criterion: known, ...numbers };
  });
}
