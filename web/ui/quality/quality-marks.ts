import type { Moment, Report } from '../../quality/client';
import type { Part } from './quality-text';

/** A moment with its rank: 1 is the worst of the dance. */
export interface Mark {
  readonly part: Part;
  readonly rank: number;
  readonly moment: Moment;
}

/** Largest number of marks over all lanes. */
const MAX_MARKS = 5;
/** Largest number of marks in the single lane of low windows and phones. */
const MAX_IN_ONE_LANE = 3;

/** The worst moments of all measures, the worst first. */
export function marksOf(report: Report): Mark[] {
  const parts: readonly Part[] = ['feet', 'closeness', 'beats', 'seams'];
  return parts
    .flatMap((part) => report[part].worst.map((moment) => ({ part, moment })))
    .sort((a, b) => b.moment.severity - a.moment.severity)
    .slice(0, MAX_MARKS)
    .map((mark, index) => ({ ...mark, rank: index + 1 }));
}

/**
 * The marks that fit into one lane without overlapping, ranked anew.
 * @param minDistance of two marks, frames
 */
export function marksInOne(marks: readonly Mark[], minDistance: number): Mark[] {
  const chosen: Mark[] = [];
  for (const mark of marks) {
    const free = chosen.every(({ moment }) => Math.abs(moment.frame - mark.moment.frame) >= minDistance);
    if (free && chosen.length < MAX_IN_ONE_LANE) chosen.push({ ...mark, rank: chosen.length + 1 });
  }
  return chosen;
}

/** The largest value of several rows in every frame; NaN where all are NaN. */
export function worstRow(rows: readonly Float32Array[]): Float32Array {
  const worst = new Float32Array(Math.max(0, ...rows.map(({ length }) => length))).fill(NaN);
  for (const row of rows) {
    row.forEach((value, frame) => {
      if (!(worst[frame]! >= value) && !Number.isNaN(value)) worst[frame] = value;
    });
  }
  return worst;
}
