import { distinct, type Person, personsOf } from './detector';
import { type Landmarks, landmarksOf } from './landmarks';
import { Cropper, type Picture } from './picture';
import { type Appearance, AppearanceModel, appearanceOf } from './appearance';
import type { PoseGraphs } from './graphs';
import type { Point, Region, Square } from './region';
import {
  distance,
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
/** Somebody is taken for the person if they differ by less than this share of what the one who is followed differs by. */
const MORE_ALIKE = 0.6;
/** How far beside whom is followed the person is looked for who is hidden behind them, shares of a region. */
const BESIDE = [-0.2, 0.2, -0.35, 0.35];
/** Sightings nearer to each other than this share of a region are of one person. */
const SAME_PERSON = 0.12;
/** Who differs for a shorter time than this is left out where others are about, seconds: so short a gap is bridged. */
const MAX_MISTAKE = 0.5;
/** Who differs for longer is the person in another light, seconds: else the person would have been found. */
const MAX_DIFFERENT = 5;
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
  /** Somebody else was followed from this time on until now, seconds of the video; null where that was not found. */
  readonly mistakenSince: number | null;
}

/** Somebody in a picture. */
interface Seen {
  readonly landmarks: Landmarks;
  readonly appearance: Appearance;
}

/** Where the detector looks, and which of the persons there may be the one to follow, the likeliest first. */
interface Search {
  readonly squares: readonly Square[];
  readonly candidates: (persons: readonly Person[]) => readonly Person[];
}

const NOT_SEEN: Tracked = { landmarks: null, persons: [], brightness: null, mistakenSince: null };

/**
 * Follows one person through the pictures of a video: the detector finds them, then each picture's landmarks say where
 * to look in the next one. Who was lost is looked for near the place where they were seen last. Where a partner comes
 * between them and the camera, the landmarks pass over to the partner: their clothes say so, and the person is looked for
 * beside them.
 */
export class PersonTracker {
  readonly #cropper = new Cropper();
  #region: Region | null = null;
  /** When the sighting that lasts began. */
  #since = 0;
  #last: Sighting | null = null;
  /** Pictures since the person was seen. */
  #unseen = 0;
  #model = new AppearanceModel();
  /** Where and when their appearance was their own last. */
  #recognised: Sighting | null = null;
  /** Pictures since then. */
  #different = 0;
  /** Somebody else was seen beside them. */
  #company = false;

  /** @param pick where the person stands who is to be followed; null takes the largest */
  constructor(
    private readonly graphs: PoseGraphs,
    private readonly pick: Point | null,
  ) {}

  /** @param time of the picture, seconds of the video */
  async next(picture: Picture, time: number): Promise<Tracked> {
    if (this.#region) return this.#follow(picture, time, this.#region);
    const unseen = this.#unseen++;
    if (unseen % SEARCH_EVERY > 0) return NOT_SEEN;
    this.#since = time;
    const [quick, ...close] = this.#searches(picture, time);
    return this.#find(picture, time, unseen % SEARCH_CLOSELY_EVERY > 0 ? [quick] : [quick, ...close]);
  }

  /** Who is in the region; the person instead, where that is somebody else and the person is found beside them. */
  async #follow(picture: Picture, time: number, region: Region): Promise<Tracked> {
    const seen = await this.#personIn(picture, region);
    const difference = seen ? this.#model.difference(seen.appearance) : 0;
    const since = this.#recognised?.time ?? time;
    const found = seen && difference > 1 ? await this.#findBeside(picture, time, seen, difference) : null;
    const passedBy = difference <= 1 && this.#company && this.#different > 0 && time - since < MAX_MISTAKE;
    if (difference > 1 && !found && time - since > MAX_DIFFERENT) this.#model = new AppearanceModel();
    return {
      ...NOT_SEEN,
      landmarks: this.#keep(found ?? seen, time),
      mistakenSince: found || passedBy ? since : null,
    };
  }

  /** The person, near whom somebody of another appearance is followed; null where they are not found. */
  async #findBeside(
    picture: Picture,
    time: number,
    { landmarks: { next } }: Seen,
    difference: number,
  ): Promise<Seen | null> {
    const recognised = this.#recognised;
    const different = ++this.#different;
    // Who is alone may differ when seen from another side, and nobody is beside them.
    const isDue = this.#company || different === SEARCH_EVERY || different % SEARCH_CLOSELY_EVERY === 0;
    if (!recognised || !isDue) return null;
    const regions = [
      recognised.region,
      ...BESIDE.map((aside) => ({ ...next, x: next.x + aside * next.size })),
    ];
    if (different % SEARCH_EVERY === 0) {
      const { persons } = await this.#detect(picture, [squareOfReach(recognised, time)]);
      regions.push(...withinReach(persons, recognised, time).map((person) => person.region));
    }
    for (const region of regions) {
      const found = await this.#personIn(picture, region);
      if (!found || distance(found.landmarks.next, next) < SAME_PERSON * next.size) continue;
      this.#company = true;
      if (this.#model.difference(found.appearance) <= Math.min(1, MORE_ALIKE * difference)) return found;
    }
    return null;
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
        if (landmarks) return { ...NOT_SEEN, landmarks, persons, brightness: brightest };
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
    return this.#keep(await this.#personIn(picture, region), time);
  }

  /** Who is in a region; null where nobody is. */
  async #personIn(picture: Picture, region: Region): Promise<Seen | null> {
    const input = this.#cropper.landmarkInput(picture, region);
    const output = await this.graphs.landmarks(input);
    const landmarks = landmarksOf(output, region);
    const isSeen = landmarks.presence >= MIN_PRESENCE && isInside(landmarks.next, picture);
    return isSeen ? { landmarks, appearance: appearanceOf(input, output.landmarks) } : null;
  }

  /** Follows from here on who was seen. */
  #keep(seen: Seen | null, time: number): Landmarks | null {
    this.#region = seen?.landmarks.next ?? null;
    if (!seen) return null;
    const { landmarks, appearance } = seen;
    const sighting = { region: landmarks.next, time };
    this.#unseen = 0;
    if (time - this.#since >= MIN_SIGHTING) this.#last = sighting;
    if (this.#model.difference(appearance) <= 1) {
      this.#model.learn(appearance);
      this.#recognised = sighting;
      this.#different = 0;
    }
    return landmarks;
  }
}

function isInside({ x, y, size }: Region, { width, height }: Picture): boolean {
  return (
    x > 0 && y > 0 && x < width && y < height && size > MIN_REGION * Math.max(width, height) && size < 1e5
  );
}
