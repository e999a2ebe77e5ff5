import { onPixelSize } from '../../common/pixel-size';
import { visibleSpan } from '../store/actions/timeline';
import type { Mount } from '../store/services';
import { watchAll } from '../store/store';
import { timeScale } from '../store/time-scale';
import { el } from '../widgets/dom';
import { surface, token } from '../widgets/lane-canvas';

/** Confidence below which a frame is marked. */
export const UNSURE = 0.5;
/** Height of the confidence under the pictures, CSS pixels. */
const BAND_PX = 6;

/** A small picture of the video. */
export interface Thumbnail {
  /** Seconds of the video. */
  readonly time: number;
  readonly image: CanvasImageSource & { readonly width: number; readonly height: number };
}

/** What the lane shows of a video. */
export interface LaneVideo {
  readonly name: string;
  readonly file: Blob;
  /** Moment of the video at which the dance begins, seconds. */
  readonly start: number;
  /** In order of time. */
  readonly thumbnails: readonly Thumbnail[];
  /** How sure each frame of the dance is, 0 to 1, at `fps`; empty before that is known. */
  readonly confidence: Float32Array;
  readonly fps: number;
}

/** The video of the leader as others see it: the feature that reads videos sets it, the lane shows it. */
export class VideoTrack {
  #video: LaneVideo | null = null;
  readonly #watchers = new Set<() => void>();

  get video(): LaneVideo | null {
    return this.#video;
  }

  /** @param change what is different from now on; null takes the video away */
  set(change: LaneVideo | null): void {
    this.#video = change;
    for (const watcher of this.#watchers) watcher();
  }

  /** Calls `changed` after every change. */
  watch(changed: () => void): void {
    this.#watchers.add(changed);
  }
}

/**
 * The lane of the leader's video: its pictures over the seconds of the dance, and how sure the motion is below them. It
 * is there only while there is a video.
 * @param track what is shown
 */
export function mountVideoLane(track: VideoTrack): Mount {
  return (lanes, store) => {
    const label = el('div', { class: 'lane-label video-lane' }, el('span', { class: 'dot' }), 'Video');
    const canvas = el('canvas', { attributes: { role: 'img' } });
    const lane = el('div', { class: 'lane video-lane' }, canvas);
    const draw = (): void => {
      const { video } = track;
      label.hidden = lane.hidden = video === null;
      if (!video) return;
      canvas.setAttribute('aria-label', describe(video));
      const on = surface(canvas);
      if (!on) return;
      const scale = timeScale(visibleSpan(store.getState()), on.width);
      drawThumbnails(on, video, scale.time);
      drawConfidence(on, video, scale.time, {
        sure: token(lane, '--leader'),
        unsure: token(lane, '--attention'),
      });
    };
    lanes.append(label, lane);
    draw();
    onPixelSize(lane, draw);
    track.watch(draw);
    watchAll(
      store,
      (state) => {
        const { from, to } = visibleSpan(state);
        return [from, to, state.theme];
      },
      draw,
    );
  };
}

function describe({ name, confidence, fps }: LaneVideo): string {
  if (confidence.length === 0) return `The video ${name} is being read`;
  const unsure = confidence.reduce((sum, value) => sum + Number(value < UNSURE), 0) / fps;
  const seconds = (confidence.length / fps).toFixed(1);
  return `The video ${name}; confidence over ${seconds} s of dance, low for ${unsure.toFixed(1)} s`;
}

type Drawn = NonNullable<ReturnType<typeof surface>>;

/** Pictures beside each other, each the last one before its left edge. */
function drawThumbnails(
  { context, width, height }: Drawn,
  { thumbnails, start }: LaneVideo,
  timeAt: (x: number) => number,
): void {
  const [first] = thumbnails;
  if (!first) return;
  const tall = height - BAND_PX;
  const wide = Math.max(8, (tall * first.image.width) / first.image.height);
  const last = thumbnails.at(-1)!.time;
  for (let x = 0; x < width; x += wide) {
    const time = timeAt(x + wide / 2) + start;
    if (time < first.time - 0.5 || time > last + 2) continue;
    const shown = thumbnails.findLast((one) => one.time <= time) ?? first;
    context.drawImage(shown.image, x, 0, wide, tall);
  }
}

/** A band that is as high as the motion is sure, and marked where it is a guess. */
function drawConfidence(
  { context, width, height }: Drawn,
  { confidence, fps }: LaneVideo,
  timeAt: (x: number) => number,
  colours: { readonly sure: string; readonly unsure: string },
): void {
  for (let x = 0; x < width; x++) {
    const [first, last] = [Math.floor(timeAt(x) * fps), Math.ceil(timeAt(x + 1) * fps)];
    if (first < 0 || first >= confidence.length) continue;
    const value = Math.min(...confidence.subarray(first, Math.max(first + 1, last)));
    const tall = value < UNSURE ? BAND_PX : Math.max(2, (BAND_PX - 1) * value);
    context.fillStyle = value < UNSURE ? colours.unsure : colours.sure;
    context.fillRect(x, height - tall, 1, tall);
  }
}
