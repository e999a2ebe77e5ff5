import type { Role } from '../../../common/role';
import { beatScores } from '../../../motion/beats/beat-match';
import type { Manifest } from '../../../model/client';
import type { SolvedMotion } from '../../../motion/skeleton/clip';
import { motionBeats } from '../../../motion/beats/motion-beats';
import { speedCurve } from './curves';
import { el, setText } from '../../widgets/dom';
import { clockTime } from '../../store/format';
import { drawCurve, drawDots, surface, token } from '../../widgets/lane-canvas';
import { roleName } from '../../store/roles';
import type { TimeScale } from '../../store/time-scale';

/** Beat score from which a motion beat counts as on the music: within two and a half frames of a music beat. */
const MIN_ON_MUSIC = 0.7;
/** Opacity of a motion that is being replaced. */
const STALE_OPACITY = 0.35;

/** What a lane draws of a motion. */
export interface DrawnMotion {
  /** m/s per frame. */
  readonly speed: Float32Array;
  readonly fps: number;
  /** Frames. */
  readonly beats: readonly number[];
}

/** Speed and beats of a motion; without the manifest, which says how beats are found, there are no beats. */
export function drawnMotion(motion: SolvedMotion, manifest: Manifest | null): DrawnMotion {
  const beats = manifest ? motionBeats(motion, manifest.quality.beats.smoothing) : [];
  return { speed: speedCurve(motion), fps: motion.fps, beats };
}

/** How a lane is drawn now. */
export interface MotionLaneView {
  readonly scale: TimeScale;
  /** Seconds of the dance. */
  readonly musicBeats: readonly number[];
  /** How far a motion beat may be from a music beat, frames. */
  readonly tolerance: number;
  /** The speed that reaches the upper edge, m/s. */
  readonly top: number;
  /** Whether a new motion is being made. */
  readonly stale: boolean;
}

/** The lane of one dancer: speed as a curve, motion beats as dots. */
interface MotionLane {
  readonly root: HTMLElement;
  readonly draw: (motion: DrawnMotion | null, picture: MotionLaneView) => void;
  /** Sets the text that the lane shows while there is no motion. */
  readonly showMessage: (text: string) => void;
}

/** @param under lies below the curve */
export function createMotionLane(role: Role, className: string, under: HTMLElement): MotionLane {
  const canvas = el('canvas');
  const message = el('span', { class: 'word' });
  const root = el('div', { class: className, attributes: { role: 'img' } }, under, canvas, message);
  const name = roleName(role);
  return {
    root,
    showMessage: (text) => {
      setText(message, text);
    },
    draw: (motion, { scale, musicBeats, tolerance, top, stale }) => {
      // Chromium may go on showing what was drawn on a canvas that is only emptied.
      canvas.hidden = motion === null;
      const on = surface(canvas);
      if (!motion) {
        root.setAttribute('aria-label', role === 'leader' ? 'No leader' : 'No reactor yet');
        return;
      }
      const scores = beatScores(
        motion.beats,
        musicBeats.map((beat) => beat * motion.fps),
        tolerance,
      );
      const beats = motion.beats.map((frame, index) => ({
        time: frame / motion.fps,
        onMusic: (scores[index] ?? 0) >= MIN_ON_MUSIC,
      }));
      root.setAttribute('aria-label', describe(name, motion, beats.filter(({ onMusic }) => onMusic).length));
      if (!on) return;
      const line = token(root, `--${role}`);
      const colours = { line, fill: token(root, `--${role}-soft`), ground: token(root, '--raised') };
      const curve = { ...motion, top };
      on.context.globalAlpha = stale ? STALE_OPACITY : 1;
      drawCurve(on, curve, scale, colours);
      drawDots(on, curve, beats, scale, colours);
    },
  };
}

/** A description of the lane for screen readers. */
function describe(name: string, { speed, fps, beats }: DrawnMotion, onMusic: number): string {
  let sum = 0;
  let max = 0;
  let maxFrame = 0;
  speed.forEach((value, frame) => {
    sum += value;
    if (value > max) [max, maxFrame] = [value, frame];
  });
  const mean = (sum / Math.max(1, speed.length)).toFixed(2);
  const counted = `${beats.length} motion beats, ${onMusic} of them on the music`;
  return `${name} speed, ${mean} metres per second on average, fastest at ${clockTime(maxFrame / fps)}; ${counted}`;
}
