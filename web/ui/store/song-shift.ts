import { bestShift, type BestShift } from '../../motion/beats/beat-match';
import { motionBeats } from '../../motion/beats/motion-beats';
import { percent } from './format';
import type { LoadedLeader, LoadedSong } from './reaction';
import type { AppState } from './state';

type Parts = Pick<AppState, 'song' | 'leader' | 'shift'>;

/** Time of the dance at which the song begins, seconds; below 0 its beginning is cut off. */
export function songStart({ leader, shift }: Pick<AppState, 'leader' | 'shift'>): number {
  return leader ? shift / leader.file.clip.fps : 0;
}

/** Beats of the song in seconds of the dance; the first ones may be before its start. */
export function musicBeats(parts: Parts): number[] {
  const start = songStart(parts);
  return parts.song?.data.rhythm.beats.map((beat) => beat + start) ?? [];
}

/** Range of shifts at which the song plays for at least a second of the dance, frames; 0 to 0 without song or leader. */
export function shiftRange({ song, leader }: Pick<AppState, 'song' | 'leader'>): {
  readonly min: number;
  readonly max: number;
} {
  if (!song || !leader) return { min: 0, max: 0 };
  const { fps, frames } = leader.file.clip;
  const songFrames = Math.floor(song.data.duration * fps);
  return { min: -Math.max(0, songFrames - fps), max: Math.max(0, frames - fps) };
}

/** `+7`, `−12`, `0`. */
export function signed(frames: number): string {
  return frames > 0 ? `+${frames}` : frames < 0 ? `\u2212${-frames}` : '0';
}

/** `+7 frames`, `−1 frame`. */
export function frameCountText(frames: number): string {
  return `${signed(frames)} ${Math.abs(frames) === 1 ? 'frame' : 'frames'}`;
}

/** `+7 frames, 0.23 s later`; without a leader there is nothing to shift against. */
export function shiftText(frames: number, { leader }: Pick<AppState, 'leader'>): string {
  if (frames === 0 || !leader) return 'not moved';
  const seconds = (Math.abs(frames) / leader.file.clip.fps).toFixed(2);
  return `${frameCountText(frames)}, ${seconds} s ${frames > 0 ? 'later' : 'earlier'}`;
}

/** A better shift of the song, or why none is suggested, as a short and as a full text. */
type ShiftAdvice =
  | { readonly better: BestShift }
  | { readonly better: null; readonly summary: string; readonly reason: string };

let cached: {
  readonly given: readonly [LoadedLeader, LoadedSong, number, AppState['manifest']];
  readonly answer: ShiftAdvice;
} | null = null;

/**
 * How much later than now the song should start so that its beats fall on the leader's motion beats, where that is
 * clearly better; null without song or leader. The last result is cached, since several panels ask for it.
 */
export function shiftAdvice({
  song,
  leader,
  shift,
  manifest,
}: Parts & Pick<AppState, 'manifest'>): ShiftAdvice | null {
  if (!song || !leader || !manifest) return null;
  const given = [leader, song, shift, manifest] as const;
  if (cached && given.every((value, i) => value === cached?.given[i])) return cached.answer;
  const { fps } = leader.file.clip;
  const music = musicBeats({ song, leader, shift }).map((beat) => beat * fps);
  const { smoothing, tolerance } = manifest.quality.beats;
  const best = bestShift(motionBeats(leader.motion, smoothing), music, tolerance);
  const { min, max } = shiftRange({ song, leader });
  const possible = best !== null && shift + best.by >= min && shift + best.by <= max;
  const answer = best?.clear && possible ? { better: best } : noBetter(best, leader);
  cached = { given, answer };
  return answer;
}

function noBetter(best: BestShift | null, { file: { clip } }: LoadedLeader): ShiftAdvice {
  if (best === null)
    return {
      better: null,
      summary: 'too few beats',
      reason: 'Too few beats were found to tell how song and leader fit. Drag the song to move it.',
    };
  const now = `The leader’s accents fit the song’s beats by ${percent(best.before)}`;
  const seconds = (Math.abs(best.by) / clip.fps).toFixed(2);
  const other =
    best.by === 0
      ? ', the best within two seconds'
      : `; the best within two seconds is ${percent(best.score)}, ${seconds} s ${best.by > 0 ? 'later' : 'earlier'}` +
        (best.clear ? '' : ', a difference that may be chance');
  return { better: null, summary: 'timing fits', reason: `${now}${other}. Drag the song to move it.` };
}
