import { mean } from '../../motion/math/statistics';
import { L } from './landmark-names';
import { LANDMARK_SIDE, LANDMARK_WIDTH } from './landmarks';

/**
 * Mean colours of trunk and thighs, 2 x RGB: a person is told from another one by their clothes. As shares of the mean colour
 * about the person, so that a lamp of another colour or brightness changes little ("grey world", Buchsbaum 1980).
 */
export type Appearance = readonly number[];

/** Where colours are taken: shares of the way down and across the trunk, and of the way from hip to knee. */
const TRUNK = { down: [0.2, 0.4, 0.6, 0.8], across: [0.25, 0.5, 0.75] };
const THIGH = [0.3, 0.5, 0.7];
/** About each of these places five pixels are taken, so far apart. */
const SPREAD = 2;
/** Of the picture every so many pixels are looked at for its mean colour, which counts as at least so bright. */
const SAMPLED = 7;
const DARKEST = 0.02;

/**
 * An appearance that differs by more than this from the person's may be somebody else's. In films of mannequins in colours of
 * people the dancer's own differ by 0.18 at the most, mostly by less than 0.1, and a partner's in other clothes by 0.3.
 */
const MAX_DIFFERENCE = 0.29;
/** So many pictures are learnt from before anybody is taken for somebody else. */
const FIRST_PICTURES = 10;
/** Share of a new picture in what is known after that. */
const LEARNING_RATE = 0.02;

type Place = readonly [x: number, y: number];

/**
 * @param input what the landmark network saw, 3 x 256 x 256, 0 to 1
 * @param landmarks 39 x 5 in pixels of it
 */
export function appearanceOf(input: Float32Array, landmarks: Float32Array): Appearance {
  const place = (i: number): Place => [landmarks[i * LANDMARK_WIDTH]!, landmarks[i * LANDMARK_WIDTH + 1]!];
  const [leftHip, rightHip] = [place(L.left_hip), place(L.right_hip)];
  const trunk = TRUNK.across.flatMap((across) => {
    const top = between(place(L.left_shoulder), place(L.right_shoulder), across);
    const bottom = between(leftHip, rightHip, across);
    return TRUNK.down.map((down) => between(top, bottom, down));
  });
  const thighs = THIGH.flatMap((down) => [
    between(leftHip, place(L.left_knee), down),
    between(rightHip, place(L.right_knee), down),
  ]);
  const around = surroundings(input);
  return [trunk, thighs].flatMap((places) =>
    meanColour(input, places).map((value, channel) => value / around[channel]!),
  );
}

/** What a person looks like, learnt while they are followed. */
export class AppearanceModel {
  #known: Appearance | null = null;
  #pictures = 0;

  /** How much somebody differs from the person, as a share of what the person may; above 1 it may be somebody else. */
  difference(appearance: Appearance): number {
    if (!this.#known || this.#pictures < FIRST_PICTURES) return 0;
    return colourDifference(appearance, this.#known) / MAX_DIFFERENCE;
  }

  learn(appearance: Appearance): void {
    this.#pictures++;
    const share = Math.max(LEARNING_RATE, 1 / this.#pictures);
    this.#known = (this.#known ?? appearance).map((value, i) => value + share * (appearance[i]! - value));
  }
}

/** Mean distance of the colours of trunk and thighs, 0 to 1.7. */
function colourDifference(a: Appearance, b: Appearance): number {
  const part = (from: number): number => Math.hypot(...[0, 1, 2].map((c) => a[from + c]! - b[from + c]!));
  return (part(0) + part(3)) / 2;
}

function between([ax, ay]: Place, [bx, by]: Place, share: number): Place {
  return [ax + (bx - ax) * share, ay + (by - ay) * share];
}

/** Mean colour of a picture, at least `DARKEST`, without what is black: that is beyond the edges of the video. */
function surroundings(input: Float32Array): number[] {
  const size = LANDMARK_SIDE * LANDMARK_SIDE;
  const sums = [0, 0, 0];
  let count = 0;
  for (let i = 0; i < size; i += SAMPLED) {
    const colour = [input[i]!, input[size + i]!, input[2 * size + i]!];
    if (Math.max(...colour) === 0) continue;
    count++;
    colour.forEach((value, channel) => (sums[channel]! += value));
  }
  return sums.map((sum) => Math.max(DARKEST, sum / Math.max(1, count)));
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
  return [0, 1, 2].map((channel) =>
    mean(pixels.map(([x, y]) => input[(channel * LANDMARK_SIDE + y) * LANDMARK_SIDE + x]!)),
  );
}
