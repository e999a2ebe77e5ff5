/** How much a deviation from the period costs, in units of the onsets' root mean square. */
const TIGHTNESS = 240;
/** Beats to either side that a beat's place is fitted to. */
const NEIGHBOURS = 4;
/** Farthest that the fit moves a beat, frames: more than the onsets' accuracy would be another beat. */
const MAX_MOVE = 1.2;
/** Share of the typical onset that the first and the last beat reach. */
const TRIM_SHARE = 0.4;

/**
 * Beats by dynamic programming (Ellis 2007) with a period that may change: frames that lie on strong onsets and about
 * one period apart, then a local straight line through them, because a frame is longer than what one hears.
 *
 * @param onset mean zero, unit mean square
 * @param periods frames a beat at each frame
 * @returns ascending frames, not whole
 */
export function beatFrames(onset: Float64Array, periods: Float64Array): number[] {
  const total = new Float64Array(onset.length);
  const previous = new Int32Array(onset.length).fill(-1);
  for (let frame = 0; frame < onset.length; frame++) {
    const period = periods[frame]!;
    const last = Math.min(frame, Math.floor(2 * period));
    let [best, at] = [0, -1];
    for (let distance = Math.ceil(period / 2); distance <= last; distance++) {
      const candidate = total[frame - distance]! - TIGHTNESS * Math.log(distance / period) ** 2;
      if (candidate > best) [best, at] = [candidate, frame - distance];
    }
    total[frame] = onset[frame]! + best;
    previous[frame] = at;
  }
  const beats: number[] = [];
  for (let frame = lastBeat(total, periods); frame >= 0; frame = previous[frame]!) beats.unshift(frame);
  const sharp = trimmed(beats, onset).map((frame) => frame + peakOffset(onset, frame));
  return sharp.map((_, index) => fitted(sharp, index));
}

/** The frame with the largest total within the last period. */
function lastBeat(total: Float64Array, periods: Float64Array): number {
  const first = Math.max(0, Math.floor(total.length - (periods.at(-1) ?? 0)));
  let best = first;
  for (let frame = first; frame < total.length; frame++) if (total[frame]! > total[best]!) best = frame;
  return total.length > 0 ? best : -1;
}

/** Drops the beats before the first and after the last that lies on an onset. */
function trimmed(beats: readonly number[], onset: Float64Array): number[] {
  const typical = Math.sqrt(beats.reduce((sum, frame) => sum + onset[frame]! ** 2, 0) / beats.length);
  const isOnset = (frame: number): boolean => onset[frame]! > TRIM_SHARE * typical;
  const first = beats.findIndex(isOnset);
  const last = beats.findLastIndex(isOnset);
  return first < 0 ? [] : beats.slice(first, last + 1);
}

/** Where the parabola through a peak and its neighbours is highest, frames from the peak, at most half of one. */
function peakOffset(values: Float64Array, frame: number): number {
  const [before, at, after] = [values[frame - 1] ?? 0, values[frame]!, values[frame + 1] ?? 0];
  const curvature = before - 2 * at + after;
  if (curvature >= 0) return 0;
  return Math.min(0.5, Math.max(-0.5, (0.5 * (before - after)) / curvature));
}

/** The place of a beat on the straight line through it and its neighbours, nearer ones weighing more. */
function fitted(beats: readonly number[], index: number): number {
  let [weights, xs, ys, xx, xy] = [0, 0, 0, 0, 0];
  for (let x = -NEIGHBOURS; x <= NEIGHBOURS; x++) {
    const y = beats[index + x];
    if (y === undefined) continue;
    const weight = (1 - (Math.abs(x) / (NEIGHBOURS + 1)) ** 3) ** 3;
    weights += weight;
    xs += weight * x;
    ys += weight * y;
    xx += weight * x * x;
    xy += weight * x * y;
  }
  const determinant = weights * xx - xs * xs;
  const at = beats[index]!;
  if (determinant < 1e-9) return at;
  const line = (ys * xx - xs * xy) / determinant;
  return Math.min(at + MAX_MOVE, Math.max(at - MAX_MOVE, line));
}
