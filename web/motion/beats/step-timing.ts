import { median } from '../math/statistics';

/** Duration of a step where there are no beats, seconds: runners take 180 steps a minute. */
const STEP = 10 / 30;
/** The longest step to beats, seconds; the shortest is half of it. Longer ones are beyond the legs in quick travel. */
const LONGEST_STEP = 14 / 30;

/**
 * How many steps have been taken by each frame by a dancer whose feet come down on the beats; not whole while a step is
 * under way. A beat has a power of two of steps, most often 1 or 2, so that steps take from a quarter to half a second;
 * whether beats were tracked at half or twice the song's tempo makes no difference. Before the first beat and after
 * the last, and where beats are missing between two, steps go on at the typical tempo.
 *
 * @param beats frames, ascending
 * @returns frames numbers, ascending, 0 at the first beat
 */
export function stepCounts(beats: readonly number[], frames: number, fps: number): Float64Array {
  const gaps = beats.slice(1).map((beat, i) => beat - beats[i]!);
  const tempo = 1 / (gaps.length > 0 ? median(gaps) : STEP * fps);
  const stepsPerBeat = 2 ** Math.ceil(-Math.log2(tempo * LONGEST_STEP * fps));
  const [first = 0] = beats;
  let counted = 0;
  let last = -1;
  return Float64Array.from({ length: frames }, (_, frame) => {
    while (beats[last + 1]! <= frame) {
      if (last >= 0) counted += Math.round(gaps[last]! * tempo);
      last++;
    }
    const gap = gaps[last];
    const rate = gap === undefined ? tempo : Math.round(gap * tempo) / gap;
    return (counted + (frame - (beats[last] ?? first)) * rate) * stepsPerBeat;
  });
}
