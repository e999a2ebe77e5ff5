import { distinct, type Person, personsOf } from './detector';
import { type Landmarks, landmarksOf } from './landmarks';
import { Cropper, type Picture } from './picture';
import type { PoseGraphs } from './graphs';
import type { Point, Region, Square } from './region';
import {
  nearestFirst,
  type Sighting,
  squareOfReach,
  squaresAbout,
  squaresOver,
  standingAt,
  wholePicture,
  withinReach,
} from './search';

/** Presence below which the person counts as lost. */
const MIN_PRESENCE = 0.5;
/** While nobody is seen the detector, which takes as long as three poses, looks at every third picture. */
const SEARCH_EVERY = 3;
/** At these it looks at squares of the picture, too, of which there are about a dozen. */
const SEARCH_CLOSELY_EVERY = 30;
/** A sighting shorter than this may be of nobody, such as of a bush: it does not say where the person is, seconds. */
export const MIN_SIGHTING = 0.3;
/** A region smaller than this share of the picture's longer side holds nobody whose pose could be seen. */
const MIN_REGION = 0.06;

/** Where a person stands who is to be followed from a moment on, seconds of the video. */
export interface PersonPick extends Point {
  readonly time: number;
}

/** What was found in one picture. */
export interface Tracked {
  /** Null where the person is not seen. */
  readonly landmarks: Landmarks | null;
  /** The persons of whom this is one, the largest first; none where the person was not looked for. */
  readonly persons: readonly Person[];
  /** Mean brightness of the picture, 0 to 1, where the person was looked for. */
  readonly brightness: number | null;
}

/** Where the detector looks, and which of the persons there may be the one to follow, the likeliest first. */
interface Search {
  readonly squares: readonly Square[];
  readonly candidates: (persons: readonly Person[]) => readonly Person[];
}

const NOT_SEEN: Tracked = { landmarks: null, persons: [], brightness: null };

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
  /** Pictures since the person was seen. */
  #unseen = 0;

  /** @param pick where the person stands who is to be followed; null takes the largest */
  constructor(
    private readonly graphs: PoseGraphs,
    private readonly pick: Point | null,
  ) {}

  /** @param time of the picture, seconds of the video */
  async next(picture: Picture, time: number): Promise<Tracked> {
    if (this.#region) return { ...NOT_SEEN, landmarks: await this.#see(picture, time, this.#region) };
    const unseen = this.#unseen++;
    if (unseen % SEARCH_EVERY > 0) return NOT_SEEN;
    this.#since = time;
    const [quick, ...close] = this.#searches(picture, time);
    return this.#find(picture, time, unseen % SEARCH_CLOSELY_EVERY > 0 ? [quick] : [quick, ...close]);
  }

  /** The first is done more often than those after it. */
  #searches(picture: Picture, time: number): [Search, ...Search[]] {
    const { pick } = this;
    const last = this.#last;
    const whole = [wholePicture(picture)];
    if (last) {
      const candidates: Search['candidates'] = (persons) => withinReach(persons, last, time);
      const near = squareOfReach(last, time);
      const first = near.side < whole[0]!.side ? [near] : whole;
      return [
        { squares: first, candidates },
        ...squaresOver(picture).map((squares) => ({ squares, candidates })),
      ];
    }
    if (pick) {
      const candidates: Search['candidates'] = (persons) => standingAt(persons, pick);
      return [
        { squares: whole, candidates },
        ...squaresAbout(pick, picture).map((square) => ({ squares: [square], candidates })),
        { squares: whole, candidates: (persons) => nearestFirst(persons, pick) },
      ];
    }
    const candidates: Search['candidates'] = (persons) => persons;
    return [
      { squares: whole, candidates },
      ...squaresOver(picture).map((squares) => ({ squares, candidates })),
    ];
  }

  async #find(picture: Picture, time: number, searches: readonly Search[]): Promise<Tracked> {
    let brightest = 0;
    for (const { squares, candidates } of searches) {
      const { persons, brightness } = await this.#detect(picture, squares);
      brightest = Math.max(brightest, brightness);
      for (const { region } of candidates(persons)) {
        const landmarks = await this.#see(picture, time, region);
        if (landmarks) return { landmarks, persons, brightness: brightest };
      }
    }
    return { ...NOT_SEEN, brightness: brightest };
  }

  /** The persons in squares of a picture, the largest first, and the mean brightness of the brightest square. */
  async #detect(
    picture: Picture,
    squares: readonly Square[],
  ): Promise<{ readonly persons: readonly Person[]; readonly brightness: number }> {
    const found: Person[] = [];
    let brightest = 0;
    for (const square of squares) {
      const { input, brightness } = this.#cropper.detectorInput(picture, square);
      brightest = Math.max(brightest, brightness);
      const { boxes, scores } = await this.graphs.detect(input);
      found.push(...personsOf(boxes, scores, square));
    }
    return { persons: distinct(found), brightness: brightest };
  }

  async #see(picture: Picture, time: number, region: Region): Promise<Landmarks | null> {
    const landmarks = landmarksOf(
      await this.graphs.landmarks(this.#cropper.landmarkInput(picture, region)),
      region,
    );
    const { next, presence } = landmarks;
    const seen = presence >= MIN_PRESENCE && isInside(next, picture);
    this.#region = seen ? next : null;
    if (!seen) return null;
    this.#unseen = 0;
    if (time - this.#since >= MIN_SIGHTING) this.#last = { region: next, time };
    return landmarks;
  }
}

function isInside({ x, y, size }: Region, { width, height }: Picture): boolean {
  return (
    x > 0 && y > 0 && x < width && y < height && size > MIN_REGION * Math.max(width, height) && size < 1e5
  );
}
