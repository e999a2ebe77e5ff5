import { type Observations, type Point } from '../../video/client';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { drawSkeleton } from './skeleton-overlay';

/** About where a person is seen: left, top, right, bottom, pixels. */
type Box = readonly [number, number, number, number];

/** People of whom one can be picked, and the picture in which they are. */
interface People {
  readonly boxes: readonly Box[];
  readonly image: ImageBitmap;
}

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
        this.#picked({ x: (offsetX / clientWidth) * width, y: (offsetY / clientHeight) * height });
      },
    },
  });
  /** Begins the choice of another person after one was read, and ends it. */
  readonly #another = textButton('btn tint', FOLLOW_ANOTHER, () => {
    if (this.choosing) this.#endChoice();
    else this.#choose();
  });
  readonly #address: string;
  readonly #skeleton = el('input', { attributes: { type: 'checkbox', checked: true } });
  #size = { width: 1, height: 1 };
  #observations: Observations | null = null;
  #people: People | null = null;

  /** @param pick is called with the place of a person that was clicked, pixels of the picture */
  constructor(
    file: Blob,
    private readonly pick: (point: Point) => void,
  ) {
    this.#address = URL.createObjectURL(file);
    this.#video = el('video', { attributes: { src: this.#address, playsinline: true, preload: 'auto' } });
    this.#video.muted = true;
    this.#another.hidden = true;
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
    this.root = el(
      'div',
      { class: 'picture-of-video' },
      el('div', { class: 'frame' }, this.#video, this.#canvas, this.#persons),
      el('label', {}, this.#skeleton, ' Skeleton over the video'),
      this.#another,
    );
  }

  /** Whether persons to choose from are shown. */
  get choosing(): boolean {
    return this.#persons.childElementCount > 0;
  }

  setSize(width: number, height: number): void {
    this.#size = { width, height };
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.root.style.setProperty('--aspect', String(width / height));
  }

  /** People who can be picked in a picture. */
  showPersons(people: People): void {
    this.#people?.image.close();
    this.#people = people;
    this.#choose();
  }

  /** Shows a box around each of the people; a click anywhere picks the nearest. */
  #choose(): void {
    if (!this.#people) return;
    const { width, height } = this.#size;
    this.#video.pause();
    drawSkeleton(this.#canvas, null, this.#people.image);
    setText(this.#another, 'Keep this person');
    this.#persons.replaceChildren(
      ...this.#people.boxes.map(([left, top, right, bottom], i) => {
        const button = el('button', {
          attributes: { type: 'button', 'aria-label': `Follow person ${i + 1} from the largest` },
          on: {
            click: (event) => {
              event.stopPropagation();
              this.#picked({ x: (left + right) / 2, y: (top + bottom) / 2 });
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
  }

  #endChoice(): void {
    this.#persons.replaceChildren();
    this.#drawAt(this.#video.currentTime);
    setText(this.#another, FOLLOW_ANOTHER);
  }

  #picked(point: Point): void {
    // First, while the person that was pressed still has the focus.
    this.pick(point);
    this.#endChoice();
    this.#another.hidden = true;
    this.#observations = null;
  }

  /** The picture that was read last; while persons can be chosen theirs stays. */
  showRead(image: ImageBitmap, landmarks: Float32Array | null): void {
    if (!this.choosing) drawSkeleton(this.#canvas, this.#skeleton.checked ? landmarks : null, image);
    image.close();
  }

  /** The whole video has been read. */
  showObservations(observations: Observations): void {
    this.#observations = observations;
    this.#endChoice();
    this.#another.hidden = this.#people === null;
  }

  showTime(
    { time, playing, speed }: { readonly time: number; readonly playing: boolean; readonly speed: number },
    start: number,
  ): void {
    if (this.choosing) return;
    const video = this.#video;
    const wanted = start + time;
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

  dispose(): void {
    this.#people?.image.close();
    this.#video.pause();
    this.#video.removeAttribute('src');
    URL.revokeObjectURL(this.#address);
  }
}
