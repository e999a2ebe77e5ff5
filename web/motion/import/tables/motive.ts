import { coordinateIn } from '../gaps';
import { sourceOfPoints } from '../keypoints';
import { refuseTooLong } from '../../retarget/length';
import { AppError } from '../../../common/error';
import { unitOfWord } from '../../retarget/axes-and-units';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource } from '../../retarget/source';

/** Most lines before the first frame. */
const HEAD_LINES = 12;

const refused = (what: string): AppError =>
  new AppError(
    'not-motion',
    `This table of Motive ${what}.`,
    'Export it in Motive as CSV with “Bones” and “Global” coordinates, or export the skeleton as BVH or FBX.',
  );

/** Whether a table is one of Motive, by its first line. */
export const isOfMotive = (firstLine: string): boolean => /^"?Format Version"?,/i.test(firstLine);

/**
 * Reads the bones of skeletons from a table that Motive of OptiTrack writes: lines for the kinds, names and values of the
 * columns, then a line a frame. A bone is at the joint where it begins.
 *
 * @param lines without those that are blank
 * @param part number of the skeleton in a take of several
 * @throws {AppError} `not-motion`, `too-long` or `too-few-frames`
 */
export function readMotive(lines: readonly string[], part: number): MotionSource {
  const head = lines.slice(0, HEAD_LINES).map((line) => line.split(',').map((cell) => cell.trim()));
  const rowOf = (title: string): string[] => head.find((cells) => cells[1] === title) ?? [];
  const stated = (key: string): string => head[0]![head[0]!.indexOf(key) + 1] ?? '';
  if (/local/i.test(stated('Coordinate Space'))) throw refused('has the bones’ places within one another');
  const [kinds, names] = [rowOf('Type'), rowOf('Name')];
  const axesAt = head.findIndex(([first]) => first === 'Frame');
  const [axes, values] = [head[axesAt] ?? [], head[axesAt - 1] ?? []];
  const columns = names.flatMap((name, column) => {
    const isPlace = kinds[column] === 'Bone' && values[column] === 'Position';
    if (!isPlace || axes[column] !== 'X' || axes[column + 2] !== 'Z') return [];
    const [dancer, joint] = [name.replace(/:[^:]*$/, ''), name.replace(/^.*:/, '')];
    return [{ dancer, joint, column }];
  });
  if (columns.length === 0) throw refused('holds no bones of a skeleton');
  const dancers = [...new Set(columns.map(({ dancer }) => dancer))];
  const at = part < dancers.length ? part : 0;
  const mine = columns.filter(({ dancer }) => dancer === dancers[at]);
  const rows = lines.slice(axesAt + 1);
  refuseTooLong(rows.length, mine.length * 3);
  const places = new Float32Array(rows.length * mine.length * 3);
  rows.forEach((row, frame) => {
    const cells = row.split(',');
    mine.forEach(({ column }, joint) => {
      for (let axis = 0; axis < 3; axis++) {
        const cell = cells[column + axis]?.trim() ?? '';
        const value = coordinateIn(cell);
        if (value === null)
          throw refused(`is damaged: "${cell.slice(0, 24)}" in frame ${frame + 1} is not a number`);
        places[(frame * mine.length + joint) * 3 + axis] = value;
      }
    });
  });
  const rate = Number(stated('Export Frame Rate'));
  return sourceOfPoints(
    { joints: mine.map(({ joint }) => ({ name: joint, parent: -1 })), places },
    {
      format: 'CSV of Motive',
      frameRate: () => checkedRate(rate > 0 ? rate : ASSUMED_FPS),
      rateAssumed: !(rate > 0),
      unit: unitOfWord(stated('Length Units')),
      upAxis: 'y',
      parts: dancers.length > 1 ? dancers.map((dancer) => dancer.slice(0, 80)) : [],
      part: at,
    },
  );
}
