import { FPS } from '../../video/client';
import { el, setVariable } from '../widgets/dom';
import { surface, token } from '../widgets/lane-canvas';

/** Confidence below which a frame is marked. */
const UNSURE = 0.5;

/** How sure the motion is over time: a curve, and a mark where it is a guess. */
export class ConfidenceStrip {
  readonly root: HTMLElement;
  readonly #canvas = el('canvas');
  #duration = 0;

  constructor() {
    this.root = el('div', { class: 'confidence', attributes: { role: 'img' } }, this.#canvas, el('i'));
  }

  /** @param confidence one number a frame, 0 to 1 */
  show(confidence: Float32Array): void {
    this.#duration = confidence.length / FPS;
    const unsure = confidence.reduce((sum, value) => sum + Number(value < UNSURE), 0) / FPS;
    this.root.setAttribute(
      'aria-label',
      `Confidence over ${this.#duration.toFixed(1)} s of dance, low for ${unsure.toFixed(1)} s`,
    );
    const on = surface(this.#canvas);
    if (!on) return;
    const colours = { sure: token(this.root, '--leader'), unsure: token(this.root, '--attention') };
    for (let x = 0; x < on.width; x++) {
      const first = Math.floor((x / on.width) * confidence.length);
      const last = Math.max(first + 1, Math.floor(((x + 1) / on.width) * confidence.length));
      const value = Math.min(...confidence.subarray(first, last));
      on.context.fillStyle = value < UNSURE ? colours.unsure : colours.sure;
      const height = Math.max(2, value * on.height);
      on.context.fillRect(x, on.height - height, 1, height);
    }
  }

  /** @param time seconds of the dance */
  showTime(time: number): void {
    setVariable(this.root, '--part', this.#duration > 0 ? Math.min(1, time / this.#duration) : 0);
  }
}
