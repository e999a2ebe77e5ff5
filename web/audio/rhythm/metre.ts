import { type Accents, strongest } from './accents';
import { harmonyChanges } from './harmony';

/** Beats in a bar. */
export type BeatsPerBar = 3 | 4;

/** How beats are grouped. */
export interface Metre {
  readonly beatsPerBar: BeatsPerBar;
  /** Number of the first beat, from 0, that begins a group of two bars: the "1" of a count of eight, or of six. */
  readonly first: number;
}

/** Beats that are looked at together, so that a lost beat does not hide the bars of a whole song. */
const WINDOW = 24;
/** How much more of the accents bars of three have to explain than bars of four, which are far more common. */
const THREE_MARGIN = 0.06;
/** Weight of a change of the pitch classes, 0 to 1, beside onset and bass, which are in standard deviations. */
const HARMONY_WEIGHT = 50;
/** How much more accented, in standard deviations, a later bar has to be than the first one to begin the count. */
const LATER_MARGIN = 0.6;

/**
 * Three or four beats a bar, by which of them explains more of the accents' variance, and where the count begins.
 *
 * @param beats frames, ascending, not whole
 */
export function metreOf(beats: readonly number[], accents: Accents): Metre {
  const onset = standardized(beats.map((beat) => strongest(accents.onset, beat)));
  const bass = standardized(beats.map((beat) => strongest(accents.bass, beat)));
  const harmony = standardized(harmonyChanges(beats, accents, 1));
  const explained = (beatsPerBar: BeatsPerBar): number =>
    [onset, bass, harmony].reduce((sum, each) => sum + meanExplained(each, beatsPerBar), 0) / 3;
  const beatsPerBar = explained(3) > explained(4) + THREE_MARGIN ? 3 : 4;
  const accent = harmonyChanges(beats, accents, beatsPerBar).map(
    (change, beat) => HARMONY_WEIGHT * change + bass[beat]! + onset[beat]!,
  );
  const bar = strongestPhase(accent, beatsPerBar);
  const phases = phaseMeans(accent, 2 * beatsPerBar);
  const later = phases[bar + beatsPerBar]! > phases[bar]! + LATER_MARGIN;
  return { beatsPerBar, first: later ? bar + beatsPerBar : bar };
}

/** The values less their mean, in standard deviations; zeros where all are the same. */
function standardized(values: readonly number[]): number[] {
  const middle = mean(values);
  const variance = mean(values.map((value) => (value - middle) ** 2));
  return values.map((value) => (variance > 1e-12 ? (value - middle) / Math.sqrt(variance) : 0));
}

/** The mean; 0 of none. */
function mean(values: readonly number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);
}

/** Means of the values of each phase, `count` of them. */
export function phaseMeans(values: readonly number[], count: number): number[] {
  return Array.from({ length: count }, (_, phase) =>
    mean(values.filter((_, index) => index % count === phase)),
  );
}

function strongestPhase(values: readonly number[], count: number): number {
  const means = phaseMeans(values, count);
  return means.indexOf(Math.max(...means));
}

/** Share of the variance that a period of so many beats explains beyond chance, averaged over windows. */
function meanExplained(values: readonly number[], period: number): number {
  const size = Math.min(WINDOW, values.length);
  const shares: number[] = [];
  for (let start = 0; start + size <= values.length; start += WINDOW / 2) {
    const part = values.slice(start, start + size);
    const middle = mean(part);
    const whole = part.reduce((sum, value) => sum + (value - middle) ** 2, 0);
    const means = phaseMeans(part, period);
    const between = part.reduce((sum, _, index) => sum + (means[index % period]! - middle) ** 2, 0);
    const chance = (period - 1) / Math.max(1, size - 1);
    shares.push(whole > 1e-9 ? (between / whole - chance) / (1 - chance) : 0);
  }
  return mean(shares);
}
