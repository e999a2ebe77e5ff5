import type { Columns } from '../../audio/client';
import type { Accent } from '../store/counting';
import type { TimeScale } from '../store/time-scale';

/** A canvas sized to its element in device pixels, with a context scaled to CSS pixels. */
interface Surface {
  readonly context: CanvasRenderingContext2D;
  readonly width: number;
  readonly height: number;
}

/** Clears a canvas and fits it to its element; null while it has no size or no context. */
export function surface(canvas: HTMLCanvasElement): Surface | null {
  const { clientWidth: width, clientHeight: height } = canvas;
  const context = canvas.getContext('2d');
  if (!context || width === 0 || height === 0) return null;
  const ratio = window.devicePixelRatio;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  context.setTransform(canvas.width / width, 0, 0, canvas.height / height, 0, 0);
  return { context, width, height };
}

/** A colour token of the style sheet, as the element sees it. */
export function token(element: Element, name: `--${string}`): string {
  return getComputedStyle(element).getPropertyValue(name).trim();
}

/** Height of the beat marks under the waveform. */
const BEATS_HEIGHT_PX = 9;
/** Least distance of beat marks; where they are denser, only bars are marked. */
const BEAT_SPACING_PX = 4;

/** Draws a waveform around its middle line. */
export function drawWave({ context, width, height }: Surface, { low, high }: Columns, colour: string): void {
  const middle = (height - BEATS_HEIGHT_PX) / 2;
  const columns = high.length;
  context.fillStyle = colour;
  for (let column = 0; column < columns; column++) {
    const up = (high[column] ?? 0) * middle;
    const down = -(low[column] ?? 0) * middle;
    const thick = Math.max(1, up + down);
    context.fillRect(
      (column / columns) * width,
      middle - Math.max(up, 0.5),
      Math.max(0.6, width / columns - 0.2),
      thick,
    );
  }
}

/** Draws beat marks under the waveform: those that begin a bar are taller, and each "1" has a line through it. */
export function drawBeats(
  { context, width, height }: Surface,
  beats: readonly { readonly time: number; readonly accent: Accent }[],
  scale: TimeScale,
  colours: { readonly bar: string; readonly beat: string; readonly line: string },
): void {
  const seen = beats.filter(({ time }) => time >= scale.from && time <= scale.to);
  const tooDense = seen.length > width / BEAT_SPACING_PX;
  for (const { time, accent } of seen) {
    const first = accent !== 'beat';
    if (tooDense && !first) continue;
    const x = Math.round(scale.x(time));
    if (accent === 'one') {
      context.fillStyle = colours.line;
      context.fillRect(x, 0, 1, height);
    }
    context.fillStyle = first ? colours.bar : colours.beat;
    context.fillRect(x, height - (first ? 7 : 4), 1, first ? 7 : 4);
  }
}

/** A dancer's speed and how it is drawn. */
interface Curve {
  /** One value per frame, m/s. */
  readonly speed: Float32Array;
  readonly fps: number;
  /** The speed that reaches the lane's upper edge, m/s. */
  readonly top: number;
}

/** Height of a curve at a time, CSS pixels from the upper edge. */
function heightAt({ speed, fps, top }: Curve, time: number, height: number): number {
  const frame = Math.min(speed.length - 1, Math.max(0, time * fps));
  const before = Math.floor(frame);
  const here = speed[before] ?? 0;
  const value = here + (frame - before) * ((speed[before + 1] ?? here) - here);
  return height - 1.5 - Math.min(1, value / top) * (height - 5);
}

/** Draws a dancer's speed over time as a filled line. */
export function drawCurve(
  { context, width, height }: Surface,
  curve: Curve,
  scale: TimeScale,
  colours: { readonly line: string; readonly fill: string },
): void {
  const right = Math.min(width, scale.x(curve.speed.length / curve.fps));
  if (right <= 0) return;
  const columns = Math.max(2, Math.round(right));
  context.beginPath();
  for (let column = 0; column < columns; column++) {
    const x = (column / (columns - 1)) * right;
    const y = heightAt(curve, scale.time(x), height);
    if (column === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
  context.strokeStyle = colours.line;
  context.lineWidth = 1.25;
  context.stroke();
  context.lineTo(right, height);
  context.lineTo(0, height);
  context.closePath();
  context.fillStyle = colours.fill;
  context.fill();
}

/** Least distance of dots; where they are denser, only those on a music beat are drawn. */
const DOT_SPACING_PX = 7;

/** Draws motion beats as dots on the curve: filled on a music beat, hollow elsewhere. */
export function drawDots(
  { context, width, height }: Surface,
  curve: Curve,
  beats: readonly { readonly time: number; readonly onMusic: boolean }[],
  scale: TimeScale,
  colours: { readonly line: string; readonly ground: string },
): void {
  const seen = beats.filter(({ time }) => time >= scale.from && time <= scale.to);
  const tooDense = seen.length > width / DOT_SPACING_PX;
  for (const { time, onMusic } of seen) {
    if (tooDense && !onMusic) continue;
    const radius = tooDense ? 1.5 : onMusic ? 3 : 1.9;
    const x = scale.x(time);
    const y = Math.max(radius + 1, Math.min(height - radius - 1, heightAt(curve, time, height)));
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = onMusic ? colours.line : colours.ground;
    context.fill();
    if (onMusic) continue;
    context.strokeStyle = colours.line;
    context.lineWidth = 1.25;
    context.stroke();
  }
}
