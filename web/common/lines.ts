import { AppError } from './error';

/** Largest number of lines: those of ten minutes of AMC, which has one for each bone of each frame, twice. */
const MAX_LINES = 5e6;

/**
 * The lines of a text; any number of blank ones at its end become one, which says that the line before it is whole.
 * @throws {AppError} `too-long` before memory is taken for lines without end, such as millions of blank ones
 */
export function linesOf(text: string): string[] {
  const used = text.trimEnd();
  let lines = 1;
  for (const breaks = /\r\n|\r|\n/g; breaks.test(used); lines++) {
    if (lines < MAX_LINES) continue;
    throw new AppError(
      'too-long',
      `The file has more than ${MAX_LINES / 1e6} million lines.`,
      'Remove blank lines, or export a shorter part of the dance.',
    );
  }
  const all = used.split(/\r\n|\r|\n/);
  return used.length < text.length ? [...all, ''] : all;
}
