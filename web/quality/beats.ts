import { beatScores } from '../motion/beats/beat-match';
import { severity, type Measure, type MomentKind, type Scale, worstMoments, worstOf } from './moments';
import { motionBeats } from '../motion/beats/motion-beats';
import type { Duet, Rules } from './rules';

/** Beat alignment with a reference; NaN where the reference has no beats. */
interface Alignment {
  /** Mean score of the reference's beats, 0 to 1: `beat_alignment` of training/evaluation/metrics/beats.py. */
  readonly value: number;
  /** The same by chance: the mean over all shifts of the reactor's beats, `chance_alignment` in Python. */
  readonly chance: number;
}

export interface BeatAlignment {
  /** With the music's beats: `bas` in Python. */
  readonly music: Alignment;
  /** With the leader's motion beats: `forward` of `bed` in Python. */
  readonly leader: Alignment;
}

/** The score of `beatScores` by the whole frames to the nearest beat, computed once for all shifts. */
function scoreTable(frames: number, tolerance: number): Float64Array {
  return Float64Array.from({ length: frames + 1 }, (_, distance) =>
    Math.exp(-(distance * distance) / (2 * tolerance ** 2)),
  );
}

/** The mean score over all circular shifts of the beats. */
function chanceAlignment(
  reference: readonly number[],
  beats: readonly number[],
  frames: number,
  table: Float64Array,
): number {
  const references = Int32Array.from(reference);
  // The beats and those one period earlier: every shift has as many of them in a row as there are beats.
  const periodic = Int32Array.from([...beats.map((beat) => beat - frames), ...beats]);
  let first = periodic.length - beats.length;
  let sum = 0;
  for (let shift = 1; shift < frames; shift++) {
    if (first > 0 && periodic[first - 1]! + shift >= 0) first--;
    const last = first + beats.length - 1;
    let nearest = first;
    for (const frame of references) {
      let far = Math.abs(frame - periodic[nearest]! - shift);
      while (nearest < last) {
        const next = Math.abs(frame - periodic[nearest + 1]! - shift);
        if (next > far) break;
        far = next;
        nearest++;
      }
      sum += table[far]!;
    }
  }
  return sum / (frames - 1) / reference.length;
}

/** Beat alignment with the reference, and its value by chance. */
function alignment(
  reference: readonly number[],
  beats: readonly number[],
  frames: number,
  tolerance: number,
): Alignment {
  const scores = beatScores(reference, beats, tolerance);
  const value = scores.reduce((sum, score) => sum + score, 0) / scores.length;
  const unknown = reference.length === 0 || beats.length === 0;
  return {
    value,
    chance: unknown ? value : chanceAlignment(reference, beats, frames, scoreTable(frames, tolerance)),
  };
}

/** Standard deviation of the Gaussian window of the local score, seconds: about two bars. */
const WINDOW = 1.5;
/** Least sum of the window's weights over beats with which the local score is defined. */
const MIN_WEIGHT = 2;

/** The score around every frame, 0 to 1; NaN where the reference has too few beats. */
function localScore(
  reference: readonly number[],
  scores: readonly number[],
  frames: number,
  fps: number,
): Float32Array {
  const deviation = WINDOW * fps;
  const [sums, weights] = [new Float64Array(frames), new Float64Array(frames)];
  reference.forEach((beat, index) => {
    const from = Math.max(0, Math.ceil(beat - 3 * deviation));
    const to = Math.min(frames - 1, Math.floor(beat + 3 * deviation));
    for (let frame = from; frame <= to; frame++) {
      const weight = Math.exp(-((frame - beat) ** 2) / (2 * deviation ** 2));
      sums[frame]! += weight * scores[index]!;
      weights[frame]! += weight;
    }
  });
  return Float32Array.from(sums, (sum, frame) =>
    weights[frame]! < MIN_WEIGHT ? NaN : sum / weights[frame]!,
  );
}

/** Twice the value by chance is fine; half of it is the limit. */
const scaleBy = ({ chance }: Alignment): Scale => ({
  fine: 2 * chance,
  limit: chance / 2,
  bad: -chance / 2,
});

/** Beat alignment of the reactor with the music (upper row) and with the leader (lower row). */
export function measureBeats(duet: Duet, rules: Rules): Measure<BeatAlignment> {
  const { frames, fps } = duet;
  const { smoothing, tolerance } = rules.beats;
  const leader = motionBeats({ positions: duet.leader, frames }, smoothing);
  const reactor = motionBeats({ positions: duet.reactor, frames }, smoothing);
  const music = duet.beats.filter((beat) => beat >= 0 && beat < frames);
  const whole: BeatAlignment = {
    music: alignment(music, reactor, frames, tolerance),
    leader: alignment(leader, reactor, frames, tolerance),
  };
  const judge = (kind: MomentKind, reference: readonly number[], as: Alignment) => {
    const local = localScore(reference, beatScores(reference, reactor, tolerance), frames, fps);
    const row = local.map((score) => severity(score, scaleBy(as)));
    return { row, worst: worstMoments(row, fps, kind, (frame) => local[frame]!) };
  };
  const rows = [judge('leader', leader, whole.leader)];
  if (music.length > 0) rows.unshift(judge('music', music, whole.music));
  return {
    whole,
    rows: rows.map(({ row }) => row),
    worst: worstOf(rows.flatMap(({ worst }) => worst)),
  };
}
