import { VARIATION_COUNT } from '../store/actions/variations';
import { headingOf } from '../../motion/skeleton/heading';
import { mostDifferentFrame } from '../../motion/skeleton/difference';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { Reaction } from '../store/reaction';
import { generatedRole } from '../store/roles';
import { danceFps } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState, Variation } from '../store/state';

/** From how far beside their front the dancers are seen, radians. */
const TO_THE_SIDE = 0.6;

/** Frames by the variations that differ most in them. */
const frames = new WeakMap<readonly Variation[], number>();

/** The frame in which all cards show their dancers: where they differ most; null while one is missing. */
export function sharedFrame({ variations }: Pick<AppState, 'variations'>): number | null {
  const dances = variations?.list.flatMap(({ reaction }) => reaction?.motion.positions ?? []) ?? [];
  if (!variations || dances.length < VARIATION_COUNT) return null;
  const frame = frames.get(variations.list) ?? mostDifferentFrame(dances);
  frames.set(variations.list, frame);
  return frame;
}

/** Draws each reaction's dancer, all in the same moment and seen from the same direction. */
export function drawFigures(
  canvases: readonly HTMLCanvasElement[],
  reactions: readonly (Reaction | null)[],
  state: AppState,
  draw: NonNullable<Services['drawFigure']>,
): void {
  const frame = sharedFrame(state) ?? Math.round(state.playback.time * danceFps(state));
  const first = reactions.find((reaction) => reaction !== null);
  const heading = (first ? headingOf(poseAt(first, frame)) : 0) + TO_THE_SIDE;
  canvases.forEach((canvas, index) => {
    if (!fitCanvas(canvas)) return;
    const motion = reactions[index]?.motion;
    const { theme } = state;
    const role = generatedRole(state);
    draw(canvas, motion ? { motion, seconds: frame / motion.fps, role, heading, theme } : null);
  });
}

/** Joint positions (22 x 3, metres) in a frame; at the end of the dance in the last one. */
function poseAt({ motion }: Reaction, frame: number): Float32Array {
  const at = Math.min(motion.frames - 1, Math.max(0, frame));
  return motion.positions.subarray(at * JOINT_COUNT * 3, (at + 1) * JOINT_COUNT * 3);
}

/** Gives the canvas the pixels of its element; false while it has no size. */
function fitCanvas(canvas: HTMLCanvasElement): boolean {
  const ratio = Math.min(2, window.devicePixelRatio);
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (width === 0 || height === 0) return false;
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  return true;
}
