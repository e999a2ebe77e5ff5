import type { BvhNode } from './bvh-hierarchy';
import { AGAIN, complaint, numberHint } from './bvh-number';
import { MotionError } from './error';

/**
 * Checks the lines of numbers from lines[first] on: enough of them, as many columns as channels, all finite numbers.
 *
 * @throws MotionError `bad-number`, `wrong-columns` or `truncated`
 */
export function readFrames(
  lines: readonly string[],
  first: number,
  stated: number,
  nodes: readonly BvhNode[],
): { frameLines: string[]; warnings: string[] } {
  const columns = nodes.flatMap(({ name, channels }) => channels.map((channel) => `${channel} of ${name}`));
  const frameLines: string[] = [];
  let left = 0;
  for (let line = first; line < lines.length; line++) {
    const text = lines[line]!.trim();
    if (text === '') continue;
    if (frameLines.length === stated) {
      left++;
      continue;
    }
    const frame = frameLines.length + 1;
    const tokens = text.split(/\s+/);
    for (let column = 0; column < Math.min(tokens.length, columns.length); column++) {
      const wrong = complaint(tokens[column]);
      if (wrong === null) continue;
      throw new MotionError(
        'bad-number',
        `Line ${line + 1}, frame ${frame}: ${wrong} (${columns[column]!}).`,
        numberHint(tokens[column]),
      );
    }
    if (tokens.length !== columns.length) {
      const isLast = lines.slice(line + 1).every((later) => later.trim() === '');
      const counts = `${tokens.length} of ${columns.length} values`;
      throw isLast && tokens.length < columns.length
        ? new MotionError(
            'truncated',
            `The file ends in the middle of frame ${frame} of ${stated}: line ${line + 1} holds ${counts}.`,
            'The file is incomplete: copy or export it again.',
          )
        : new MotionError(
            'wrong-columns',
            `Line ${line + 1}, frame ${frame}: ${tokens.length} values, but the skeleton has ${columns.length} channels.`,
            AGAIN,
          );
    }
    frameLines.push(text);
  }
  if (frameLines.length < stated) {
    throw new MotionError(
      'truncated',
      `The file says that it has ${stated} frames, but only ${frameLines.length} are there.`,
      'The file is incomplete: copy or export it again.',
    );
  }
  const warnings =
    left > 0 ? [`${left} frames beyond the ${stated} that the file states were left out.`] : [];
  return { frameLines, warnings };
}
