import type { Quat } from '../motion/math/quat';
import { CameraTurn, type Circle, circleAbout, comparedSize } from './pose/camera-turn';
import { CutFinder } from './pose/cuts';
import { GreyReader } from './pose/grey';
import { LANDMARK_COUNT, type Landmarks } from './pose/landmarks';
import type { Picture } from './pose/picture';
import type { Tracked } from './pose/tracker';
import { DEFAULT_FOCAL } from './world/camera';

/** What was seen in the pictures of a video, one row a picture that was read. */
export interface Observations {
  /** Size of the pictures, pixels. */
  readonly width: number;
  readonly height: number;
  /** Seconds of the video, ascending. */
  readonly times: Float64Array;
  /** Presence of the person, 0 where they are not seen: their other numbers are 0 then. */
  readonly presence: Float32Array;
  /** rows x 33 x 2, pixels. */
  readonly image: Float32Array;
  /** rows x 33 x 3, metres, as the network gives them: see `Landmarks`. */
  readonly world: Float32Array;
  /** rows x 33, 0 to 1. */
  readonly visibility: Float32Array;
  /** rows x 2, the middle of what the network saw, pixels. */
  readonly centre: Float32Array;
  /** rows x 4, how the camera turned from the first picture on, as `CameraTurn` has it with the usual focal length. */
  readonly turn: Float32Array;
  /** Times of the first pictures after a cut to another place, camera or time, seconds of the video. */
  readonly cuts: readonly number[];
  /** Greatest mean brightness of a picture without the person, 0 to 1; 1 when they were always seen. */
  readonly brightest: number;
}

/** Collects observations while a video is being read. */
export class Recorder {
  readonly #rows: { readonly time: number; readonly landmarks: Landmarks | null; readonly turn: Quat }[] = [];
  readonly #camera = new CameraTurn(DEFAULT_FOCAL);
  readonly #cuts = new CutFinder();
  readonly #grey: GreyReader;
  /** Where the dancer was seen last. */
  #dancer: Circle | null = null;
  #brightest: number | null = null;

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {
    this.#grey = new GreyReader(comparedSize(width, height));
  }

  add(time: number, picture: Picture, tracked: Tracked): void {
    const longer = Math.max(this.width, this.height);
    if (tracked.landmarks) this.#dancer = circleAbout(tracked.landmarks.region, longer);
    const grey = { ...this.#grey.size, values: this.#grey.read(picture) };
    if (this.#cuts.next(grey, time)) this.#camera.restart();
    const turn = this.#camera.next(grey, this.#dancer);
    const { landmarks, mistakenSince } = tracked;
    if (mistakenSince !== null) this.#forget(mistakenSince);
    this.#rows.push({ time, landmarks, turn });
    if (tracked.brightness !== null) this.#brightest = Math.max(this.#brightest ?? 0, tracked.brightness);
  }

  /** Leaves out what was seen of somebody else. */
  #forget(since: number): void {
    for (let row = this.#rows.length - 1; row >= 0 && this.#rows[row]!.time > since; row--)
      this.#rows[row] = { ...this.#rows[row]!, landmarks: null };
  }

  /** All that was seen so far. */
  observations(): Observations {
    const rows = this.#rows.length;
    const numbers = (columns: number): Float32Array => new Float32Array(rows * columns);
    const out = {
      width: this.width,
      height: this.height,
      times: Float64Array.from(this.#rows, ({ time }) => time),
      presence: numbers(1),
      image: numbers(2 * LANDMARK_COUNT),
      world: numbers(3 * LANDMARK_COUNT),
      visibility: numbers(LANDMARK_COUNT),
      centre: numbers(2),
      turn: numbers(4),
      cuts: this.#cuts.times,
      brightest: this.#brightest ?? 1,
    };
    this.#rows.forEach(({ landmarks, turn }, row) => {
      out.turn.set(turn, row * 4);
      if (!landmarks) return;
      out.presence[row] = landmarks.presence;
      out.image.set(landmarks.image, row * 2 * LANDMARK_COUNT);
      out.world.set(landmarks.world, row * 3 * LANDMARK_COUNT);
      out.visibility.set(landmarks.visibility, row * LANDMARK_COUNT);
      out.centre.set([landmarks.region.x, landmarks.region.y], row * 2);
    });
    return out;
  }
}
