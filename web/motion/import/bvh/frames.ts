import { type BvhNode, truncated } from './hierarchy';
import { HINT_EXPORT_AGAIN, numberProblem, numberHint } from './number';
import { refuseTooLong } from '../../retarget/length';
import { AppError } from '../../../common/error';

/** The frames of a file, checked. */
interface ReadFrames {
  readonly frameLines: readonly string[];
  /** Sentences about what was left out. */
  readonly warnings: readonly string[];
  /** Whether the file ends before its last frame is complete; `frameLines` are then the complete ones. */
  readonly truncated: boolean;
}

/** Index of the last line that is not blank. */
function lastLine(lines: readonly string[]): number {
  let last = lines.length - 1;
  while (last > 0 && lines[last]!.trim() === '') last--;
  return last;
}

/**
 * Checks the lines of numbers from lines[first] on: as many columns as channels, all finite numbers. Where the file ends
 * too early, its complete frames are used.
 *
 * @throws {AppError} `bad-number`, `wrong-columns`, `truncated` or `too-long`
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
  refuseTooLong(Math.min(stated, last + 1 - first), columns.length);
  let extra = 0;
  for (let line = first; line <= last; line++) {
    const text = lines[line]!.trim();
    if (text === '') continue;
    if (frameLines.length === stated) {
      extra++;
      continue;
    }
    const frame = frameLines.length + 1;
    const tokens = text.split(/\s+/);
    const wrong = lineProblem(tokens, columns, `Line ${line + 1}, frame ${frame}`);
    // Even where all values are there, the last one may lack digits when the file ends with it.
    const unfinished = frame < stated || tokens.length < columns.length;
    if (line === last && unfinished && (wrong || (frame < stated && last === lines.length - 1)))
      return endedWithin(frame, stated, frameLines, wrong);
    if (wrong) throw wrong;
    frameLines.push(text);
  }
  if (frameLines.length < stated) return endedAfter(stated, frameLines);
  const warnings = extra > 0 ? [leftOut(extra, stated)] : [];
  return { frameLines, warnings, truncated: false };
}

/** The sentence about frames beyond those that the file states. */
function leftOut(extra: number, stated: number): string {
  const [frames, were] = extra === 1 ? ['frame', 'was'] : ['frames', 'were'];
  return `${extra} ${frames} beyond the ${stated} that the file states ${were} left out.`;
}

/** The error in a line of numbers; null when there is none. */
function lineProblem(tokens: readonly string[], columns: readonly string[], where: string): AppError | null {
  for (let column = 0; column < Math.min(tokens.length, columns.length); column++) {
    const wrong = numberProblem(tokens[column]);
    if (wrong === null) continue;
    return new AppError(
      'bad-number',
      `${where}: ${wrong} (${columns[column]!}).`,
      numberHint(tokens[column]),
    );
  }
  if (tokens.length === columns.length) return null;
  const counts = `${tokens.length} values, but the skeleton has ${columns.length} channels`;
  return new AppError('wrong-columns', `${where}: ${counts}.`, HINT_EXPORT_AGAIN);
}

/** Fewest complete frames that are used. */
const MIN_FRAMES = 2;

/** The file ends within a frame. */
function endedWithin(
  frame: number,
  stated: number,
  frameLines: readonly string[],
  wrong: AppError | null,
): ReadFrames {
  const where = `The file ends in the middle of frame ${frame} of ${stated}`;
  if (frameLines.length >= MIN_FRAMES) return completeFrames(where, frameLines);
  // A single line with decimal commas is an error of its own, not a file that ends too early.
  if (wrong && wrong.hint !== HINT_EXPORT_AGAIN) throw wrong;
  throw truncated(`${where}: ${tooFew(frameLines.length)}.`);
}

/** The file ends after a complete frame. */
function endedAfter(stated: number, frameLines: readonly string[]): ReadFrames {
  if (frameLines.length >= MIN_FRAMES)
    return completeFrames(`The file ends after frame ${frameLines.length} of ${stated}`, frameLines);
  throw truncated(`The file says that it has ${stated} frames, but ${tooFew(frameLines.length)}.`);
}

function tooFew(count: number): string {
  return count === 0 ? 'no whole frame is there' : 'only one whole frame is there, a pose and not a motion';
}

function completeFrames(where: string, frameLines: readonly string[]): ReadFrames {
  const warning = `${where}; the ${frameLines.length} whole frames are used.`;
  return { frameLines, warnings: [warning], truncated: true };
}
