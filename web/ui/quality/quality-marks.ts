import type { Moment, Report } from '../../quality/client';
import type { Part } from './quality-words';

/** A moment with its number: 1 is the worst of the dance. */
export interface Mark {
  readonly part: Part;
  readonly rank: number;
  readonly moment: Moment;
}

/** Marks over all lanes, so that each one still says: look here first. */
const MOST = 5;
/** Marks in the one row of low windows and phones. */
const MOST_IN_ONE = 3;

/** The worst moments of all measures, the worst first. */
export function marksOf(report: Report): Mark[] {
  const parts: readonly Part[] = ['feet', 'closeness', 'beats', 'seams'];
  return parts
    .flatMap((part) => report[part].worst.map((moment) => ({ part, moment })))
    .sort((a, b) => b.moment.concern - a.moment.concern)
    .slice(0, MOST)
    .map((mark, index) => ({ ...mark, rank: index + 1 }));
}

/**
 * Those that fit into one row without lying on each other; they keep their numbers' order.
 * @param apart frames that the width of a mark stands for
 */
export function marksInOne(marks: readonly Mark[], apart: number): Mark[] {
  const kept: Mark[] = [];
  for (const mark of marks) {
    const free = kept.every(({ moment }) => Math.abs(moment.frame - mark.moment.frame) >= apart);
    if (free && kept.length < MOST_IN_ONE) kept.push({ ...mark, rank: kept.length + 1 });
  }
  return kept;
}

/** The worst of several rows in every frame; NaN where none has anything to say. */
export function worstRow(rows: readonly Float32Array[]): Float32Array {
  const worst = new Float32Array(Math.max(0, ...rows.map(({ length }) => length))).fill(NaN);
  for (const row of rows) {
    row.forEach((value, frame) => {
      if (!(worst[frame]! >= value) && !Number.isNaN(value)) worst[frame] = value;
    });
  }
  return worst;
}
