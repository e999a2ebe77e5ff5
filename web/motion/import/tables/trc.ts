import { coordinateIn } from '../gaps';
import { sourceOfPoints } from '../keypoints';
import { refuseTooLong } from '../../retarget/length';
import { AppError } from '../../../common/error';
import { linesOf } from '../../../common/lines';
import { unitOfWord } from '../../retarget/axes-and-units';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource } from '../../retarget/source';

/** Lines before the first frame: two of the file, its values, the markers, and the axes of each. */
const HEAD_LINES = 5;
/** Cells of a line before those of the first marker: frame and time. */
const FIRST = 2;

const damaged = (what: string): AppError =>
  new AppError('unreadable-file', `The TRC file is damaged: ${what}.`, 'Export or download it again.');

const cellsOf = (line: string): string[] => line.split('\t').map((cell) => cell.trim());

/**
 * Reads the places of markers over time, as OpenSim, OpenCap, Pose2Sim, Motive and Cortex write them. A marker that was
 * not seen has empty cells.
 *
 * @throws {AppError} `unreadable-file`, `too-long` or `too-few-frames`
 */
export function readTrc(text: string): MotionSource {
  const lines = linesOf(text);
  const [keys, values, titles] = [1, 2, 3].map((line) => cellsOf(lines[line] ?? '')) as [
    string[],
    string[],
    string[],
  ];
  const stated = (key: string): string => values[keys.findIndex((one) => one.toLowerCase() === key)] ?? '';
  const names = titles.slice(FIRST).filter((name) => name !== '');
  if (names.length === 0) throw damaged('it names no markers');
  const rows = lines.slice(HEAD_LINES).filter((line) => line.trim() !== '');
  const width = names.length * 3;
  refuseTooLong(rows.length, width);
  const places = new Float32Array(rows.length * width);
  rows.forEach((row, frame) => {
    const cells = cellsOf(row).slice(FIRST);
    for (let i = 0; i < width; i++) {
      const cell = cells[i] ?? '';
      const value = coordinateIn(cell);
      if (value === null) throw damaged(`"${cell.slice(0, 24)}" in frame ${frame + 1} is not a number`);
      places[frame * width + i] = value;
    }
  });
  const rate = Number(stated('datarate'));
  return sourceOfPoints(
    { joints: names.map((name) => ({ name, parent: -1 })), places },
    {
      format: 'TRC',
      frameRate: () => checkedRate(rate > 0 ? rate : ASSUMED_FPS),
      rateAssumed: !(rate > 0),
      unit: unitOfWord(stated('units')),
      upAxis: null,
    },
  );
}
