import { beatScores } from '../motion/beats/beat-match';
import { concern, type Measure, type MomentKind, type Scale, worstMoments, worstOf } from './moments';
import { motionBeats } from '../motion/beats/motion-beats';
import type { Duet, Rules } from './rules';

/** How well the reactor's beats fall on those of somebody else; NaN where the other has none. */
export interface Alignment {
  /** Mean score of the other's beats, 0 to 1: `beat_alignment` of training/evaluation/metrics/beats.py. */
  readonly value: number;
  /** The same by accident: the mean over all shifts of the reactor's beats, `chance_alignment` in Python. */
  readonly chance: number;
}

export interface BeatAlignment {
  /** With the music's beats: `bas` in Python. */
  readonly music: Alignment;
  /** With the leader's motion beats: `forward` of `bed` in Python. */
  readonly leader: Alignment;
  /** The leader's with the reactor's: `backward` of `bed`. */
  readonly backward: Alignment;
  readonly leaderBeats: number;
  readonly reactorBeats: number;
}

/** What `beatScores` gives, by the whole frames to the nearest beat: over all shifts it is asked for too often. */
function scoreTable(frames: number, tolerance: number): Float64Array {
  return Float64Array.from({ length: frames + 1 }, (_, far) => Math.exp(-(far * far) / (2 * tolerance ** 2)));
}

/** The mean score over all shifts of the beats. What leaves at the end comes in at the start. */
function chanceOf(
  reference: readonly number[],
  beats: readonly number[],
  frames: number,
  table: Float64Array,
): number {
  const references = Int32Array.from(reference);
  // Those of this round and of the one before: each shift shows as many of them in a row as there are beats.
  const rounds = Int32Array.from([...beats.map((beat) => beat - frames), ...beats]);
  let first = rounds.length - beats.length;
  let sum = 0;
  for (let shift = 1; shift < frames; shift++) {
    if (first > 0 && rounds[first - 1]! + shift >= 0) first--;
    const last = first + beats.length - 1;
    let nearest = first;
    for (const frame of references) {
      let far = Math.abs(frame - rounds[nearest]! - shift);
      while (nearest < last) {
        const next = Math.abs(frame - rounds[nearest + 1]! - shift);
        if (next > far) break;
        far = next;
        nearest++;
      }
      sum += table[far]!;
    }
  }
  return sum / (frames - 1) / reference.length;
}

/** How well the beats fall on the reference, and how well they would by accident. */
export function alignment(
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
    chance: unknown ? value : chanceOf(reference, beats, frames, scoreTable(frames, tolerance)),
  };
}

/** Standard deviation of the window in which the score is felt, seconds: about two bars. */
const FELT = 1.5;
/** Beats that the window must hold to say anything. */
const ENOUGH = 2;

/** The score around every frame, 0 to 1; NaN where the reference has too few beats. */
export function localScore(
  reference: readonly number[],
  scores: readonly number[],
  frames: number,
  fps: number,
): Float32Array {
  const deviation = FELT * fps;
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
  return Float32Array.from(sums, (sum, frame) => (weights[frame]! < ENOUGH ? NaN : sum / weights[frame]!));
}

/** Twice what accident gives is fine; half of it is the limit, as nothing meets there. */
const scaleBy = ({ chance }: Alignment): Scale => ({
  fine: 2 * chance,
  limit: chance / 2,
  bad: -chance / 2,
});

/** Beat alignment of the reactor with the music (upper row) and with the leader (lower row). */
export function measureBeats(duet: Duet, rules: Rules): Measure<BeatAlignment> {
  const { frames, fps } = duet;
  const { smoothing, tolerance } = rules.beats;
  const lead = motionBeats({ positions: duet.leader, frames }, smoothing);
  const own = motionBeats({ positions: duet.reactor, frames }, smoothing);
  const music = duet.beats.filter((beat) => beat >= 0 && beat < frames);
  const whole: BeatAlignment = {
    music: alignment(music, own, frames, tolerance),
    leader: alignment(lead, own, frames, tolerance),
    backward: alignment(own, lead, frames, tolerance),
    leaderBeats: lead.length,
    reactorBeats: own.length,
  };
  const heard = (kind: MomentKind, reference: readonly number[], as: Alignment) => {
    const local = localScore(reference, beatScores(reference, own, tolerance), frames, fps);
    const row = local.map((score) => concern(score, scaleBy(as)));
    return { row, worst: worstMoments(row, fps, kind, (frame) => local[frame]!) };
  };
  const rows = [heard('leader', lead, whole.leader)];
  if (music.length > 0) rows.unshift(heard('music', music, whole.music));
  return {
    whole,
    rows: rows.map(({ row }) => row),
    worst: worstOf(rows.flatMap(({ worst }) => worst)),
  };
}
