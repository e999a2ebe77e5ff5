import { LANDMARK_SIDE } from './landmarks';

/** Mean colours of trunk and thighs, 2 x RGB, 0 to 1: a person is told from another one by their clothes. */
export type Look = readonly number[];

/** Landmarks, left and right: shoulders, hips and knees. */
const [SHOULDERS, HIPS, KNEES] = [
  [11, 12],
  [23, 24],
  [25, 26],
] as const;
/** Numbers of a landmark. */
const WIDTH = 5;
/** Where colours are taken: shares of the way down and across the trunk, and of the way from hip to knee. */
const TRUNK = { down: [0.2, 0.4, 0.6, 0.8], across: [0.25, 0.5, 0.75] };
const THIGH = [0.3, 0.5, 0.7];
/** About each of these places five pixels are taken, so far apart. */
const SPREAD = 2;

/**
 * A look that differs by more than this from the person's may be somebody else's. In films of mannequins in colours of
 * people the dancer's own differ by 0.18 at the most, mostly by less than 0.1, and a partner's in other clothes by 0.3.
 */
const OTHER_LOOK = 0.16;
/** So many looks are learnt before any is strange. */
const FIRST_LOOKS = 10;
/** Share of a new look in what is known after that. */
const NEW_LOOK = 0.02;

type Place = readonly [x: number, y: number];

/**
 * @param input what the landmark network saw, 3 x 256 x 256, 0 to 1
 * @param landmarks 39 x 5 in pixels of it
 */
export function lookOf(input: Float32Array, landmarks: Float32Array): Look {
  const place = (i: number): Place => [landmarks[i * WIDTH]!, landmarks[i * WIDTH + 1]!];
  const [shoulders, hips, knees] = [SHOULDERS, HIPS, KNEES].map((pair) => pair.map(place));
  const trunk = TRUNK.across.flatMap((across) => {
    const [top, bottom] = [shoulders!, hips!].map(([left, right]) => between(left!, right!, across));
    return TRUNK.down.map((down) => between(top!, bottom!, down));
  });
  const thighs = hips!.flatMap((hip, side) => THIGH.map((down) => between(hip, knees![side]!, down)));
  return [...meanColour(input, trunk), ...meanColour(input, thighs)];
}

/** What a person looks like, learnt while they are followed. */
export class KnownLook {
  #look: Look | null = null;
  #count = 0;

  /** How much a look differs from the person's; one above 1 may be somebody else's. */
  strangeness(look: Look): number {
    return this.#look && this.#count >= FIRST_LOOKS ? difference(look, this.#look) / OTHER_LOOK : 0;
  }

  learn(look: Look): void {
    this.#count++;
    const share = Math.max(NEW_LOOK, 1 / this.#count);
    this.#look = (this.#look ?? look).map((value, i) => value + share * (look[i]! - value));
  }
}

/** Mean distance of the colours of two looks, 0 to 1.7. */
function difference(a: Look, b: Look): number {
  const part = (from: number): number => Math.hypot(...[0, 1, 2].map((c) => a[from + c]! - b[from + c]!));
  return (part(0) + part(3)) / 2;
}

function between([ax, ay]: Place, [bx, by]: Place, share: number): Place {
  return [ax + (bx - ax) * share, ay + (by - ay) * share];
}

/** Mean colour about places of a picture, without what is outside of it; black where all are. */
function meanColour(input: Float32Array, places: readonly Place[]): number[] {
  const pixels = places
    .flatMap(([x, y]): Place[] => [
      [x, y],
      [x + SPREAD, y],
      [x - SPREAD, y],
      [x, y + SPREAD],
      [x, y - SPREAD],
    ])
    .map(([x, y]): Place => [Math.round(x), Math.round(y)])
    .filter(([x, y]) => x >= 0 && y >= 0 && x < LANDMARK_SIDE && y < LANDMARK_SIDE);
  return [0, 1, 2].map((channel) => {
    const values = pixels.map(([x, y]) => input[(channel * LANDMARK_SIDE + y) * LANDMARK_SIDE + x]!);
    return values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);
  });
}
