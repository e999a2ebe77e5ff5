import { readFrames } from './frames';
import { type BvhNode, readHierarchy } from './hierarchy';
import { HINT_EXPORT_AGAIN } from './number';
import { linesOf } from '../../../common/lines';
import { AppError } from '../../../common/error';

/** A BVH file in which every number has been checked. */
export interface BvhFile {
  readonly nodes: readonly BvhNode[];
  /** Values of one frame a line, as many numbers as there are channels. */
  readonly frameLines: readonly string[];
  /** Frame time as written, seconds. */
  readonly frameTime: string;
  readonly warnings: readonly string[];
  /** Whether the file ends before its last frame is complete; `frameLines` are then the complete ones. */
  readonly truncated: boolean;
}

/** Line and value of a header entry such as "Frames: 12" on the next line that is not blank; null where it is missing. */
function headerEntry(
  lines: readonly string[],
  from: number,
  key: RegExp,
): { line: number; value: string } | null {
  for (let line = from; line < lines.length; line++) {
    const text = lines[line]!.trim();
    if (text === '') continue;
    const match = key.exec(text);
    return match ? { line, value: match[1]!.trim() } : null;
  }
  return null;
}

/**
 * Splits a BVH file into hierarchy and frames and checks every number. Of a file that ends too early the complete
 * frames are used.
 *
 * @throws {AppError} `empty-file`, `not-bvh`, `truncated`, `bad-hierarchy`, `bad-number`, `wrong-columns`,
 *   `too-few-frames` or `too-long`, naming the line, and the joint where there is one
 */
export function parseBvhText(text: string): BvhFile {
  const lines = linesOf(text.replace(/^\uFEFF/, ''));
  const start = lines.findIndex((line) => line.trim() !== '');
  if (start < 0) {
    throw new AppError('empty-file', 'The motion file is empty.', 'Choose a BVH file with a dance in it.');
  }
  if (lines[start]!.trim().split(/\s/)[0]!.toUpperCase() !== 'HIERARCHY') {
    throw new AppError(
      'not-bvh',
      'This is not a BVH file: it does not begin with HIERARCHY.',
      'Export the motion as BVH, for example from Blender (File, Export, Motion Capture).',
    );
  }
  const motion = lines.findIndex((line) => /^\s*MOTION\s*$/i.test(line));
  const nodes = readHierarchy(lines, motion < 0 ? lines.length : motion);
  if (motion < 0) {
    throw new AppError(
      'truncated',
      `The file ends at line ${lines.length}, after the skeleton: its motion is missing.`,
      'The file is incomplete, or holds only a rest pose: export it again with its animation.',
    );
  }
  const frames = headerEntry(lines, motion + 1, /^Frames\s*:(.*)$/i);
  const time = frames && headerEntry(lines, frames.line + 1, /^Frame\s+Time\s*:(.*)$/i);
  if (!frames || !time) {
    const missing = frames ? '"Frame Time:"' : '"Frames:"';
    throw new AppError(
      'bad-hierarchy',
      `After MOTION in line ${motion + 1}, ${missing} is missing.`,
      HINT_EXPORT_AGAIN,
    );
  }
  const stated = Number(frames.value);
  if (frames.value === '' || !Number.isInteger(stated) || stated < 0) {
    const where = `Line ${frames.line + 1}: "${frames.value}" is not a number of frames.`;
    throw new AppError('bad-number', where, HINT_EXPORT_AGAIN);
  }
  const { frameLines, warnings, truncated } = readFrames(lines, time.line + 1, stated, nodes);
  if (stated < 2) {
    throw new AppError(
      'too-few-frames',
      stated === 1 ? 'The file holds one frame, a pose and not a motion.' : 'The file holds no frames.',
      'Export the whole animation, not only its current frame.',
    );
  }
  return { nodes, frameLines, frameTime: time.value, warnings, truncated };
}
