import { BONES } from '../../video/client';

/** Width of the lines, as a share of the picture's longer side. */
const LINE = 0.006;
const COLOURS = { left: '#ffd166', right: '#4cc9f0', middle: '#ffffff' } as const;

/**
 * Draws the landmarks of a body, left and right in two colours.
 * @param landmarks 33 x 2, pixels of the canvas; null draws none
 * @param picture what is drawn below them; null leaves the canvas clear
 */
export function drawSkeleton(
  canvas: HTMLCanvasElement,
  landmarks: ArrayLike<number> | null,
  picture: CanvasImageSource | null = null,
): void {
  const context = canvas.getContext('2d');
  if (!context) return;
  context.clearRect(0, 0, canvas.width, canvas.height);
  if (picture) context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  if (!landmarks) return;
  context.lineWidth = LINE * Math.max(canvas.width, canvas.height);
  context.lineCap = 'round';
  for (const { from, to, side } of BONES) {
    context.strokeStyle = COLOURS[side];
    context.beginPath();
    context.moveTo(landmarks[2 * from]!, landmarks[2 * from + 1]!);
    context.lineTo(landmarks[2 * to]!, landmarks[2 * to + 1]!);
    context.stroke();
  }
}
