import { coordinateIn } from '../gaps';
import { sourceOfPoints } from '../keypoints';
import { refuseTooLong } from '../../retarget/length';
import { leaderFirst } from '../positions';
import { isOfMotive, readMotive } from './motive';
import { AppError } from '../../../common/error';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource, SourceJoint } from '../../retarget/source';
import { PARENTS, SMPL22 } from '../../skeleton/skeleton';
import { linesOf } from '../../../common/lines';

const SEPARATOR = /[,;\t]/;
/** `leader_left_hip_x`, `left_hip.x` or `LeftHip X`: the dancer if there is one, the joint, and the axis. */
const COLUMN = /^(?:(leader|reactor|follower|dancer\d*)[_. :/])?(.{1,80}?)[_. :/]?\(?([xyz])\)?$/i;
/** The title of a column of times, in seconds or with `ms` in milliseconds. */
const TIME = /^(time|seconds|t)(\W.*|_ms)?$/i;
/** What FreeMoCap writes before the joints of the body, where there are hands and a face beside it. */
const BODY = /^body_/i;
/** Largest number of columns. */
const MAX_COLUMNS = 3000;

function invalid(what: string): AppError {
  return new AppError(
    'not-motion',
    `This CSV file does not hold a motion: ${what}.`,
    'The first line names a column for every joint and axis, as left_hip_x; one line a frame follows.',
  );
}

function byPoint(): AppError {
  return new AppError(
    'not-motion',
    'This CSV file has a line for every point instead of one for every frame.',
    'Of a recording of FreeMoCap use mediapipe_body_3d_xyz.csv, in its folder output_data.',
  );
}

/** A title or value without the quotes about it. */
const unquoted = (cell: string): string =>
  cell
    .trim()
    .replace(/^"(.*)"$/, '$1')
    .trim();

interface Column {
  readonly dancer: string;
  readonly joint: string;
  readonly axis: number;
  readonly column: number;
}

function columnsOf(titles: readonly string[]): Column[] {
  return titles.flatMap((title, column) => {
    const match = COLUMN.exec(title);
    const [, dancer = '', joint = '', axis = ''] = match ?? [];
    return match ? [{ dancer, joint, axis: 'xyz'.indexOf(axis.toLowerCase()), column }] : [];
  });
}

const isSame = (a: string, b: string): boolean => a.toLowerCase() === b.toLowerCase();

/** The dancers that the columns name, each as in its first column. */
function dancersOf(columns: readonly Column[]): string[] {
  const found = new Map<string, string>();
  for (const { dancer } of columns) {
    const key = dancer.toLowerCase();
    found.set(key, found.get(key) ?? dancer);
  }
  return leaderFirst([...found.values()], (name) => name);
}

/** Joints under their names; the 22 keep the parents that they have in their own skeleton. */
function jointsOf(names: readonly string[]): SourceJoint[] {
  const all = names.length === SMPL22.length && names.every((name, i) => name.toLowerCase() === SMPL22[i]);
  return names.map((name, i) => ({ name, parent: all ? PARENTS[i]! : -1 }));
}

/** Frames per second from a column of seconds, or from a comment `# fps: 30`; null where neither is there. */
function rateOf(comments: readonly string[], times: readonly number[]): number | null {
  const stated = /fps\W+(\d+(?:\.\d+)?)/i.exec(comments.join('\n'))?.[1];
  if (stated !== undefined) return Number(stated);
  const [first, last] = [times[0], times.at(-1)];
  if (first === undefined || last === undefined || times.length < 2 || !(last > first)) return null;
  return Math.round(((times.length - 1) / (last - first)) * 1000) / 1000;
}

/** Positions, frames x joints x 3, and the seconds of every frame where there is a column of them. */
function readRows(
  rows: readonly string[],
  separator: string,
  titles: readonly string[],
  columns: readonly Column[],
  names: readonly string[],
): { places: Float32Array; times: number[] } {
  const places = new Float32Array(rows.length * names.length * 3);
  const time = titles.findIndex((title) => TIME.test(title));
  const unitsPerSecond = /(\W|_)ms\b/i.test(titles[time] ?? '') ? 1000 : 1;
  const times: number[] = [];
  const slots = new Map(names.map((name, joint) => [name, joint]));
  const wanted = columns.filter(({ joint }) => slots.has(joint));
  rows.forEach((row, frame) => {
    const cells = row.split(separator);
    for (const { joint, axis, column } of wanted) {
      const cell = unquoted(cells[column] ?? '');
      const value = coordinateIn(cell);
      if (value === null) throw badCell(frame, cell, titles[column]!);
      places[(frame * names.length + slots.get(joint)!) * 3 + axis] = value;
    }
    if (time >= 0) times.push(Number(unquoted(cells[time] ?? '')) / unitsPerSecond);
  });
  return { places, times };
}

function badCell(frame: number, cell: string, title: string): AppError {
  return new AppError(
    'bad-number',
    `Frame ${frame + 1}: "${cell.slice(0, 24)}" is not a number (${title.slice(0, 40)}).`,
    'Export the table again, with a decimal point.',
  );
}

/**
 * Reads joint positions from a table: a line of titles, then one line a frame. Lines that begin with # are comments.
 *
 * @param part number of the dancer in a table with several
 * @throws {AppError} `not-motion`, `bad-number`, `too-long`, `too-few-frames` or `bad-frame-time`
 */
export function readCsv(text: string, part: number): MotionSource {
  const lines = linesOf(text);
  const comments = lines.filter((line) => line.startsWith('#'));
  const rows = lines.filter((line) => line.trim() !== '' && !line.startsWith('#'));
  if (isOfMotive(rows[0] ?? '')) return readMotive(rows, part);
  const separator = SEPARATOR.exec(rows[0] ?? '')?.[0] ?? ',';
  const titles = (rows[0] ?? '').split(separator).map(unquoted);
  if (titles.length > MAX_COLUMNS) throw invalid(`it has ${titles.length} columns`);
  const columns = columnsOf(titles);
  const dancers = dancersOf(columns);
  const at = part < dancers.length ? part : 0;
  const mine = columns.filter(({ dancer }) => isSame(dancer, dancers[at]!));
  const whole = [...new Set(mine.map(({ joint }) => joint))].filter(
    (joint) => new Set(mine.filter((one) => one.joint === joint).map(({ axis }) => axis)).size === 3,
  );
  const body = whole.filter((name) => BODY.test(name));
  const names = body.length > 0 ? body : whole;
  if (names.length < 3) {
    // FreeMoCap has a table with a line for every point of every frame, too.
    if (titles.includes('keypoint')) throw byPoint();
    throw invalid('its first line names no joints with x, y and z');
  }
  refuseTooLong(rows.length - 1, names.length * 3);
  const { places, times } = readRows(rows.slice(1), separator, titles, mine, names);
  const rate = rateOf(comments, times);
  return sourceOfPoints(
    { joints: jointsOf(names), places },
    {
      format: 'CSV',
      frameRate: () => checkedRate(rate ?? ASSUMED_FPS),
      rateAssumed: rate === null,
      unit: null,
      upAxis: null,
      parts: dancers.length > 1 ? dancers : [],
      part: at,
    },
  );
}
