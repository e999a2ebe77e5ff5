import type { Peaks } from './curves';

/** A canvas sized to its element in device pixels, with a context scaled to CSS pixels. */
export interface Surface {
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

/** Height under the waveform that the beat marks take, CSS pixels. */
const BEATS = 9;

/** A waveform, mirrored about its middle and as tall as its loudest sample allows. */
export function drawWave({ context, width, height }: Surface, { low, high }: Peaks, colour: string): void {
  const loudest = Math.max(1e-3, ...high, ...low.map((value) => -value));
  const middle = (height - BEATS) / 2;
  const columns = high.length;
  context.fillStyle = colour;
  for (let column = 0; column < columns; column++) {
    const up = ((high[column] ?? 0) / loudest) * middle;
    const down = (-(low[column] ?? 0) / loudest) * middle;
    const thick = Math.max(1, up + down);
    context.fillRect(
      (column / columns) * width,
      middle - Math.max(up, 0.5),
      Math.max(0.6, width / columns - 0.2),
      thick,
    );
  }
}

/** Beat marks under the waveform, each fourth one taller, with its hairline through the waveform. */
export function drawBeats(
  { context, width, height }: Surface,
  beats: readonly number[],
  seconds: number,
  colours: { readonly bar: string; readonly beat: string; readonly line: string },
): void {
  const tooDense = beats.length > width / 4;
  beats.forEach((beat, index) => {
    const first = index % 4 === 0;
    if (beat > seconds || (tooDense && !first)) return;
    const x = Math.round((beat / seconds) * width);
    if (first) {
      context.fillStyle = colours.line;
      context.fillRect(x, 0, 1, height);
    }
    context.fillStyle = first ? colours.bar : colours.beat;
    context.fillRect(x, height - (first ? 7 : 4), 1, first ? 7 : 4);
  });
}

/** A dancer's speed over time as a filled line; `top` is the speed in m/s that reaches the lane's upper edge. */
export function drawCurve(
  { context, width, height }: Surface,
  curve: Float32Array,
  top: number,
  colours: { readonly line: string; readonly fill: string },
): void {
  const floor = height - 1.5;
  const last = Math.max(1, curve.length - 1);
  context.beginPath();
  const columns = Math.min(curve.length, Math.round(width));
  for (let column = 0; column < columns; column++) {
    const part = columns > 1 ? column / (columns - 1) : 0;
    const speed = curve[Math.round(part * last)] ?? 0;
    const y = floor - Math.min(1, speed / top) * (height - 5);
    if (column === 0) context.moveTo(0, y);
    else context.lineTo(part * width, y);
  }
  context.strokeStyle = colours.line;
  context.lineWidth = 1.25;
  context.stroke();
  context.lineTo(width, height);
  context.lineTo(0, height);
  context.closePath();
  context.fillStyle = colours.fill;
  context.fill();
}
