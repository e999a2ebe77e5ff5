import { personsOf, type Person } from './detector';
import { type Landmarks, landmarksOf } from './landmarks';
import { Cropper, type Picture } from './picture';
import type { PoseGraphs } from './graphs';
import type { Region } from './region';

/** Presence below which the person counts as lost. */
const MIN_PRESENCE = 0.5;
/** While nobody is seen the detector, which takes as long as three poses, looks at every third picture. */
const DETECT_EVERY = 3;
/** A sighting shorter than this may be of nobody, such as of a bush: it does not say where the person is, seconds. */
export const MIN_SIGHTING = 0.3;
/**
 * How far from where they were lost a person may be found, in sides of their region (about 2.4 m): at once, and more a
 * second. Otherwise whoever else is in the picture would be followed.
 */
const REACH = { atOnce: 0.5, perSecond: 1 };
/** A region smaller than this share of the picture's longer side holds nobody whose pose could be seen. */
const MIN_REGION = 0.06;

/** A point of the picture, pixels. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Where a person stands who is to be followed from a moment on, seconds of the video. */
export interface PersonPick extends Point {
  readonly time: number;
}

/** What was found in one picture. */
export interface Tracked {
  /** Null where the person is not seen. */
  readonly landmarks: Landmarks | null;
  /** The persons in the picture, where the detector was asked. */
  readonly persons: readonly Person[] | null;
  /** Mean brightness of the picture, 0 to 1, where the detector was asked. */
  readonly brightness: number | null;
}

/** Where and when a person was seen. */
export interface Sighting {
  readonly region: Region;
  /** Seconds of the video. */
  readonly time: number;
}

/**
 * Follows one person through the pictures of a video: the detector finds them, then each picture's landmarks say where
 * to look in the next one. Who was lost is looked for near the place where they were seen last.
 */
export class PersonTracker {
  readonly #cropper = new Cropper();
  #region: Region | null = null;
  /** When the sighting that lasts began. */
  #since = 0;
  #last: Sighting | null = null;
  #undetected = 0;

  /** @param pick where the person stands who is to be followed; null takes the largest */
  constructor(
    private readonly graphs: PoseGraphs,
    private readonly pick: Point | null,
  ) {}

  /** @param time of the picture, seconds of the video */
  async next(picture: Picture, time: number): Promise<Tracked> {
    if (this.#region)
      return { ...(await this.#see(picture, time, this.#region)), persons: null, brightness: null };
    if (this.#undetected++ % DETECT_EVERY > 0) return { landmarks: null, persons: null, brightness: null };
    const { persons, brightness } = await detectPersons(this.graphs, this.#cropper, picture);
    const found = this.#last ? sameAsLast(persons, this.#last, time) : nearest(persons, this.pick);
    this.#since = time;
    const seen = found ? await this.#see(picture, time, found.region) : { landmarks: null };
    return { ...seen, persons, brightness };
  }

  async #see(picture: Picture, time: number, region: Region): Promise<Pick<Tracked, 'landmarks'>> {
    const landmarks = landmarksOf(
      await this.graphs.landmarks(this.#cropper.landmarkInput(picture, region)),
      region,
    );
    const { next, presence } = landmarks;
    const seen = presence >= MIN_PRESENCE && isInside(next, picture);
    this.#region = seen ? next : null;
    if (!seen) return { landmarks: null };
    this.#undetected = 0;
    if (time - this.#since >= MIN_SIGHTING) this.#last = { region: next, time };
    return { landmarks };
  }
}

/** The persons in a picture, the largest first, and its mean brightness, 0 to 1. */
export async function detectPersons(
  graphs: PoseGraphs,
  cropper: Cropper,
  picture: Picture,
): Promise<{ readonly persons: readonly Person[]; readonly brightness: number }> {
  const { input, toPicture, brightness } = cropper.detectorInput(picture);
  const { boxes, scores } = await graphs.detect(input);
  return { persons: personsOf(boxes, scores, toPicture), brightness };
}

/** The person nearest to where one was seen last, if they can have come so far. */
export function sameAsLast(
  persons: readonly Person[],
  { region, time }: Sighting,
  now: number,
): Person | undefined {
  const reach = region.size * (REACH.atOnce + REACH.perSecond * (now - time));
  const found = nearest(persons, region);
  return found && distance(found.region, region) <= reach ? found : undefined;
}

/** The person nearest to a point, or the largest without one. */
function nearest(persons: readonly Person[], point: Point | null): Person | undefined {
  if (!point) return persons[0];
  return [...persons].sort((a, b) => distance(a.region, point) - distance(b.region, point))[0];
}

const distance = (a: Point, b: Point): number => Math.hypot(a.x - b.x, a.y - b.y);

function isInside({ x, y, size }: Region, { width, height }: Picture): boolean {
  return (
    x > 0 && y > 0 && x < width && y < height && size > MIN_REGION * Math.max(width, height) && size < 1e5
  );
}
