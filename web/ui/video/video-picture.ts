import type { Observations, People, ReadReport } from '../../video/client';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { drawSkeleton } from './skeleton-overlay';
import type { PanelActions } from './video-panel';

/** How far the video may be from the dance before it is set right, seconds. */
const MAX_DRIFT = 0.12;

const FOLLOW_ANOTHER = 'Follow another person';

/** The picture of a video with the skeleton that was found over it. */
export class VideoPicture {
  readonly root: HTMLElement;
  readonly #video: HTMLVideoElement;
  readonly #canvas = el('canvas', { attributes: { 'aria-hidden': 'true' } });
  readonly #persons = el('div', {
    class: 'persons',
    on: {
      click: ({ offsetX, offsetY }) => {
        const { clientWidth, clientHeight } = this.#persons;
        const { width, height } = this.#size;
        this.#picked((offsetX / clientWidth) * width, (offsetY / clientHeight) * height);
      },
    },
  });
  /** Begins the choice of another person, and ends it. */
  readonly #another = textButton('btn tint', FOLLOW_ANOTHER, () => {
    if (this.choosing) this.#endChoice();
    else this.#look();
  });
  /** The moment that is shown, seconds of the video; while a person is chosen it can be moved. */
  readonly #moment = el('input', {
    attributes: { type: 'range', step: 0.1, 'aria-label': 'Moment of the video' },
    on: {
      input: () => {
        this.#persons.replaceChildren();
        drawSkeleton(this.#canvas, null);
        this.#video.currentTime = this.#moment.valueAsNumber;
        this.#sayMoment();
      },
      change: () => {
        this.#look();
      },
    },
  });
  readonly #hint = el('span', { attributes: { 'aria-live': 'polite' } });
  readonly #choice = el('div', { class: 'choice' }, this.#hint, this.#moment);
  readonly #frame: HTMLElement;
  readonly #address: string;
  readonly #skeleton = el('input', { attributes: { type: 'checkbox', checked: true } });
  #size = { width: 1, height: 1 };
  #observations: Observations | null = null;
  /** Whether the visitor has asked for the choice, which then outlasts the reading. */
  #byVisitor = false;
  /** Of the picture in which a person is chosen, seconds of the video. */
  #time = 0;

  constructor(
    file: Blob,
    private readonly actions: Pick<PanelActions, 'look' | 'pick'>,
  ) {
    this.#address = URL.createObjectURL(file);
    this.#video = el('video', { attributes: { src: this.#address, playsinline: true, preload: 'auto' } });
    this.#video.muted = true;
    this.#another.hidden = this.#choice.hidden = true;
    this.#video.setAttribute('aria-label', 'The video');
    // What the page can read its player may still refuse, such as MOV: the skeleton is shown alone then.
    this.#video.addEventListener('error', () => {
      this.#video.hidden = true;
    });
    for (const moved of ['timeupdate', 'seeked'])
      this.#video.addEventListener(moved, () => {
        if (this.#observations) this.#drawAt(this.#video.currentTime);
      });
    this.#skeleton.addEventListener('change', () => {
      this.#drawAt(this.#video.currentTime);
    });
    this.#frame = el('div', { class: 'frame' }, this.#video, this.#canvas, this.#persons);
    this.root = el(
      'div',
      { class: 'picture-of-video' },
      this.#choice,
      this.#frame,
      this.#another,
      el('label', {}, this.#skeleton, ' Skeleton over the video'),
    );
  }

  /** Whether persons to choose from are shown. */
  get choosing(): boolean {
    return !this.#choice.hidden;
  }

  setVideo({ width, height, start, end }: Extract<ReadReport, { kind: 'opened' }>): void {
    this.#size = { width, height };
    Object.assign(this.#moment, { min: start, max: end });
    this.#another.hidden = false;
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.root.style.setProperty('--aspect', String(width / height));
  }

  /** Shows the picture of a moment with a box around each of the people; a click anywhere picks the nearest. */
  showPeople({ time, boxes, image }: People): void {
    const { width, height } = this.#size;
    this.#choice.hidden = false;
    this.#moment.valueAsNumber = this.#time = time;
    this.#sayMoment();
    this.#video.pause();
    drawSkeleton(this.#canvas, null, image);
    image.close();
    setText(this.#another, 'Keep this person');
    const found = boxes.length > 0 ? '' : 'Nobody is found here. ';
    setText(this.#hint, `${found}Click the person to follow from this moment on, or choose another moment.`);
    this.#persons.replaceChildren(
      ...boxes.map(([left, top, right, bottom], i) => {
        const button = el('button', {
          attributes: { type: 'button', 'aria-label': `Follow person ${i + 1} from the largest` },
          on: {
            click: (event) => {
              event.stopPropagation();
              this.#picked((left + right) / 2, (top + bottom) / 2);
            },
          },
        });
        Object.assign(button.style, {
          left: `${(100 * left) / width}%`,
          top: `${(100 * top) / height}%`,
          width: `${(100 * (right - left)) / width}%`,
          height: `${(100 * (bottom - top)) / height}%`,
        });
        return button;
      }),
    );
    this.#frame.scrollIntoView({ block: 'nearest' });
  }

  /** Tells screen readers the moment that can be chosen. */
  #sayMoment(): void {
    this.#moment.setAttribute('aria-valuetext', `${this.#moment.valueAsNumber.toFixed(1)} seconds`);
  }

  #look(): void {
    this.#byVisitor = true;
    this.actions.look(this.#moment.valueAsNumber);
  }

  #endChoice(): void {
    this.#byVisitor = false;
    this.#choice.hidden = true;
    this.#persons.replaceChildren();
    this.#drawAt(this.#video.currentTime);
    setText(this.#another, FOLLOW_ANOTHER);
  }

  /** @param x, y place of a person, pixels of the picture */
  #picked(x: number, y: number): void {
    // First, while the person that was pressed still has the focus.
    this.actions.pick({ x, y, time: this.#time });
    this.#endChoice();
    this.#observations = null;
  }

  /** The picture that was read last; while persons can be chosen theirs stays. */
  showRead({ time, image, landmarks }: Extract<ReadReport, { kind: 'picture' }>): void {
    if (!this.choosing) {
      drawSkeleton(this.#canvas, this.#skeleton.checked ? landmarks : null, image);
      this.#moment.valueAsNumber = time;
    }
    image.close();
  }

  /** The whole video has been read. */
  showObservations(observations: Observations): void {
    this.#observations = observations;
    if (!this.#byVisitor) this.#endChoice();
  }

  showTime(
    { time, playing, speed }: { readonly time: number; readonly playing: boolean; readonly speed: number },
    start: number,
  ): void {
    if (this.choosing) return;
    const video = this.#video;
    const wanted = start + time;
    this.#moment.valueAsNumber = wanted;
    video.playbackRate = speed;
    if (playing && video.paused) void video.play().catch(() => undefined);
    if (!playing && !video.paused) video.pause();
    if (Math.abs(video.currentTime - wanted) > (playing ? MAX_DRIFT : 0.01)) video.currentTime = wanted;
    this.#drawAt(wanted);
  }

  #drawAt(time: number): void {
    const { times, presence, image } = this.#observations ?? {};
    if (!times || !presence || !image || this.choosing) return;
    let low = 0;
    let high = times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle]! <= time + 1e-3) low = middle;
      else high = middle - 1;
    }
    const size = image.length / Math.max(1, times.length);
    const seen = this.#skeleton.checked && presence[low]! > 0;
    drawSkeleton(this.#canvas, seen ? image.subarray(low * size, (low + 1) * size) : null, this.#still());
  }

  /** The video where it stands still: Chromium may go on showing the picture from before it was moved while paused. */
  #still(): HTMLVideoElement | null {
    const { paused, seeking, readyState, hidden } = this.#video;
    return paused && !seeking && !hidden && readyState >= HTMLMediaElement.HAVE_CURRENT_DATA
      ? this.#video
      : null;
  }

  pause(): void {
    this.#video.pause();
  }

  dispose(): void {
    this.pause();
    this.#video.removeAttribute('src');
    URL.revokeObjectURL(this.#address);
  }
}
