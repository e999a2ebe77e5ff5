import type { MeasureRow, Verdict } from '../widgets/info-card';
import { percent } from '../store/format';
import type { Reference } from '../store/state';
import type { Report } from '../../quality/client';
import { NOTHING, type Part, score } from './quality-text';

const missing = (value: number | null | undefined): value is null | undefined =>
  value === null || value === undefined || Number.isNaN(value);

/** For numbers that should be small: multiples of the reference up to which they are good and so-so. */
const [GOOD_TIMES, FAIR_TIMES] = [1.15, 1.75];
/** For scores above chance: shares of the recorded dancers' gain from which they are good and so-so. */
const [GOOD_GAIN, FAIR_GAIN] = [0.75, 0.25];
/** Scores that differ by less count as equal. */
const EQUAL_WITHIN = 0.03;

/** The verdict on a number that should not be larger than its reference. */
export function verdictAtMost(value: number, reference: number | null | undefined): Verdict | null {
  if (missing(reference) || Number.isNaN(value)) return null;
  if (value <= reference * GOOD_TIMES) return 'good';
  return value <= reference * FAIR_TIMES ? 'so-so' : 'poor';
}

/** The verdict on a number that should be neither much less nor much more than its reference. */
export function verdictNear(value: number, reference: number | null | undefined): Verdict | null {
  if (missing(reference) || Number.isNaN(value)) return null;
  return verdictAtMost(Math.max(value, reference), Math.min(value, reference));
}

/**
 * The verdict on a score that should be as far above chance as that of recorded dancers. Where theirs is not above
 * chance either, a score at chance says nothing and counts as so-so.
 */
export function verdictAboveChance(
  value: number,
  chance: number,
  recorded: number | null | undefined,
): Verdict | null {
  if (Number.isNaN(value) || Number.isNaN(chance)) return null;
  const best = missing(recorded) ? chance : recorded;
  if (best - chance < EQUAL_WITHIN) {
    if (value - chance >= EQUAL_WITHIN) return 'good';
    return value > chance - EQUAL_WITHIN ? 'so-so' : 'poor';
  }
  const gain = (value - chance) / (best - chance);
  if (gain >= GOOD_GAIN) return 'good';
  return gain >= FAIR_GAIN ? 'so-so' : 'poor';
}

/** The measures of a dance for the cards, by lane. */
export function measureRows(
  { feet, closeness, beats, seams }: Report,
  reference: Reference | null,
): Readonly<Record<Part, readonly MeasureRow[]>> {
  const write = (value: number, how: (value: number) => string): string =>
    Number.isNaN(value) ? NOTHING : how(value);
  const recorded = (value: number | null | undefined, how: (value: number) => string): string =>
    missing(value) ? '' : `recorded ${how(value)}`;
  const onBeat = (
    name: string,
    beat: Report['beats']['whole']['music'],
    known: number | null | undefined,
  ) => ({
    name: `On the ${name}’s beat`,
    hint: Number.isNaN(beat.value) ? `no beats of the ${name} found` : 'from 0, never, to 1, always',
    value: write(beat.value, score),
    beside: Number.isNaN(beat.value)
      ? ''
      : [recorded(known, score), `by chance ${score(beat.chance)}`].filter(Boolean).join(', '),
    verdict: verdictAboveChance(beat.value, beat.chance, known),
  });
  const { whole: foot } = feet;
  const { whole: close } = closeness;
  const deep =
    close.overlapShare > 0 ? `of the dance, ${(close.deepest * 100).toFixed(0)} cm at most` : 'never';
  return {
    feet: [
      {
        name: 'Feet slide',
        hint: 'of their time on the floor',
        value: write(foot.skateShare, percent),
        beside: recorded(reference?.skateShare, percent),
        verdict: verdictAtMost(foot.skateShare, reference?.skateShare),
      },
      {
        name: 'Feet on the floor',
        hint: 'of the dance',
        value: write(foot.contactShare, percent),
        beside: recorded(reference?.contactShare, percent),
        verdict: verdictNear(foot.contactShare, reference?.contactShare),
      },
    ],
    closeness: [
      {
        name: 'Bodies overlap',
        hint: `${deep}; hips never nearer than ${close.closest.toFixed(2)} m`,
        value: percent(close.overlapShare),
        beside: recorded(reference?.overlapShare, percent),
        verdict: verdictAtMost(close.overlapShare, reference?.overlapShare),
      },
    ],
    beats: [
      onBeat('music', beats.whole.music, reference?.music),
      onBeat('leader', beats.whole.leader, reference?.leader),
    ],
    seams: [
      {
        name: 'Seams between blocks',
        hint: 'times the change elsewhere',
        value: seams.whole.seams === 0 ? NOTHING : write(seams.whole.ratio, score),
        beside: seams.whole.seams === 0 ? '' : 'unseen around 1',
        verdict: seams.whole.seams === 0 ? null : verdictAtMost(seams.whole.ratio, 1.1),
      },
    ],
  };
}
