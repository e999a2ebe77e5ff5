import type { BvhNode } from './hierarchy';
import { AGAIN, complaint, numberHint } from './number';
import { AppError } from '../../common/error';

/** The frames of a file, looked at. */
export interface ReadFrames {
  readonly frameLines: readonly string[];
  /** What was left out, in sentences. */
  readonly warnings: readonly string[];
  /** Does the file end before its last frame does? `frameLines` are then those that are whole. */
  readonly cutOff: boolean;
}

/** A file that ends before its last frame, as a download that broke off does. */
export function cutOff(message: string): AppError {
  return new AppError('truncated', message, 'The file is incomplete: download, copy or export it again.');
}

/** The last line in which something is written. */
function lastLine(lines: readonly string[]): number {
  let last = lines.length - 1;
  while (last > 0 && lines[last]!.trim() === '') last--;
  return last;
}

/**
 * Checks the lines of numbers from lines[first] on: as many columns as channels, all finite numbers. Where the file ends
 * too early, its whole frames are used.
 *
 * @throws {AppError} `bad-number`, `wrong-columns` or `truncated`
 */
export function readFrames(
  lines: readonly string[],
  first: number,
  stated: number,
  nodes: readonly BvhNode[],
): ReadFrames {
  const columns = nodes.flatMap(({ name, channels }) => channels.map((channel) => `${channel} of ${name}`));
  const frameLines: string[] = [];
  const last = lastLine(lines);
  let left = 0;
  for (let line = first; line <= last; line++) {
    const text = lines[line]!.trim();
    if (text === '') continue;
    if (frameLines.length === stated) {
      left++;
      continue;
    }
    const frame = frameLines.length + 1;
    const tokens = text.split(/\s+/);
    const wrong = problemOf(tokens, columns, `Line ${line + 1}, frame ${frame}`);
    // Even where all values are there, the last one lacks digits when the file ends with it.
    const unfinished = frame < stated || tokens.length < columns.length;
    if (line === last && unfinished && (wrong || (frame < stated && last === lines.length - 1)))
      return endedIn(frame, stated, frameLines, wrong);
    if (wrong) throw wrong;
    frameLines.push(text);
  }
  if (frameLines.length < stated) return endedAfter(stated, frameLines);
  const warnings =
    left > 0 ? [`${left} frames beyond the ${stated} that the file states were left out.`] : [];
  return { frameLines, warnings, cutOff: false };
}

/** What is wrong with a line of numbers; null when nothing is. */
function problemOf(tokens: readonly string[], columns: readonly string[], where: string): AppError | null {
  for (let column = 0; column < Math.min(tokens.length, columns.length); column++) {
    const wrong = complaint(tokens[column]);
    if (wrong === null) continue;
    return new AppError(
      'bad-number',
      `${where}: ${wrong} (${columns[column]!}).`,
      numberHint(tokens[column]),
    );
  }
  if (tokens.length === columns.length) return null;
  const counts = `${tokens.length} values, but the skeleton has ${columns.length} channels`;
  return new AppError('wrong-columns', `${where}: ${counts}.`, AGAIN);
}

/** Frames that make a motion. */
const FEWEST = 2;

function endedIn(
  frame: number,
  stated: number,
  frameLines: readonly string[],
  wrong: AppError | null,
): ReadFrames {
  const where = `The file ends in the middle of frame ${frame} of ${stated}`;
  if (frameLines.length >= FEWEST) return used(where, frameLines);
  // A file of one line that is written with decimal commas is not cut off.
  if (wrong && wrong.hint !== AGAIN) throw wrong;
  throw cutOff(`${where}: ${tooFew(frameLines.length)}.`);
}

function endedAfter(stated: number, frameLines: readonly string[]): ReadFrames {
  if (frameLines.length >= FEWEST)
    return used(`The file ends after frame ${frameLines.length} of ${stated}`, frameLines);
  throw cutOff(`The file says that it has ${stated} frames, but ${tooFew(frameLines.length)}.`);
}

function tooFew(count: number): string {
  return count === 0 ? 'no whole frame is there' : 'only one whole frame is there, a pose and not a motion';
}

function used(where: string, frameLines: readonly string[]): ReadFrames {
  const warning = `${where}; the ${frameLines.length} whole frames are used.`;
  return { frameLines, warnings: [warning], cutOff: true };
}
