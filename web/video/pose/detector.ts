import { type Region, regionAround, type Square } from './region';

/** Side of the detector's picture, pixels. */
export const DETECTOR_SIDE = 224;
/** Smallest score of a person. */
const MIN_SCORE = 0.5;
/** Scores are logits; sigmoid(MIN_LOGIT) = MIN_SCORE. */
const MIN_LOGIT = Math.log(MIN_SCORE / (1 - MIN_SCORE));
/** Numbers of a box: middle, size, and four key points of which the first two are the alignment points. */
const BOX_WIDTH = 12;
const CENTRE = 4;
const EDGE = 6;
/** Share of the smaller box that two boxes of the same person cover of each other, at the least. */
const MAX_OVERLAP = 0.3;
/** Cells of the detector's layers along a side, and anchors in a cell, as in MediaPipe's SsdAnchorsCalculator. */
const LAYERS = [
  { cells: 28, anchors: 2 },
  { cells: 14, anchors: 2 },
  { cells: 7, anchors: 6 },
] as const;

/** Width and height of a standing person, shares of the region's side. */
const BODY = { width: 0.45, height: 0.8 };

/** A person in a picture. */
export interface Person {
  readonly score: number;
  /** The box of face or trunk, pixels: left, top, right, bottom. */
  readonly box: readonly [number, number, number, number];
  readonly region: Region;
}

/** Middles of the anchors' cells, x and y of each, shares of the side. */
const ANCHORS = Float32Array.from(
  LAYERS.flatMap(({ cells, anchors }) =>
    Array.from({ length: cells * cells }, (_, cell) => [
      ((cell % cells) + 0.5) / cells,
      (Math.floor(cell / cells) + 0.5) / cells,
    ]).flatMap((middle) => Array.from({ length: anchors }, () => middle).flat()),
  ),
);

/**
 * What the detector took for persons, each of them several times.
 * @param boxes anchors x 12, and `scores`, one logit an anchor, as the graph returns them
 * @param square what the detector saw
 */
export function personsOf(boxes: Float32Array, scores: Float32Array, { x, y, side }: Square): Person[] {
  const found: Person[] = [];
  scores.forEach((logit, anchor) => {
    if (!(logit > MIN_LOGIT)) return;
    const value = (i: number): number => boxes[anchor * BOX_WIDTH + i]! / DETECTOR_SIDE;
    const point = (i: number) => ({
      x: x + (value(i) + ANCHORS[2 * anchor]!) * side,
      y: y + (value(i + 1) + ANCHORS[2 * anchor + 1]!) * side,
    });
    const middle = point(0);
    const [width, height] = [value(2) * side, value(3) * side];
    found.push({
      score: 1 / (1 + Math.exp(-logit)),
      box: [middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2],
      region: regionAround(point(CENTRE), point(EDGE)),
    });
  });
  return found;
}

/** Non-maximum suppression: of boxes that cover each other the one with the best score. The largest persons first. */
export function distinct(persons: readonly Person[]): Person[] {
  const kept: Person[] = [];
  for (const person of [...persons].sort((a, b) => b.score - a.score))
    if (kept.every((other) => overlap(person.box, other.box) < MAX_OVERLAP)) kept.push(person);
  return kept.sort((a, b) => b.region.size - a.region.size);
}

/** Intersection over union of two boxes. */
function overlap(a: Person['box'], b: Person['box']): number {
  const width = Math.min(a[2], b[2]) - Math.max(a[0], b[0]);
  const height = Math.min(a[3], b[3]) - Math.max(a[1], b[1]);
  if (width <= 0 || height <= 0) return 0;
  const area = ([left, top, right, bottom]: Person['box']): number => (right - left) * (bottom - top);
  return (width * height) / (area(a) + area(b) - width * height);
}

/** About where a whole person is seen: left, top, right, bottom, pixels. */
export function bodyBox({ region: { x, y, size } }: Person): [number, number, number, number] {
  const [across, down] = [(BODY.width * size) / 2, (BODY.height * size) / 2];
  return [x - across, y - down, x + across, y + down];
}
