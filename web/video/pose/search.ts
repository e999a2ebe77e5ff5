import type { Person } from './detector';
import type { Point, Region, Square } from './region';

interface Size {
  readonly width: number;
  readonly height: number;
}

/**
 * Sides of the squares that are looked at one after the other until somebody is found, shares of the picture's shorter
 * side. The detector finds persons who are a quarter of its picture high or more, so a dancer who is a third as high as
 * a landscape video is only found in a square of it.
 */
const SIDES = [1, 2 / 3];
/** The same about a point that was picked: there is only one square of each side. */
const SIDES_ABOUT_POINT = [1, 2 / 3, 1 / 3];
/**
 * How far from where they were lost a person may be found, in sides of their region (about 2.4 m): at once, and more a
 * second. Otherwise whoever else is in the picture would be followed.
 */
const REACH = { atOnce: 0.5, perSecond: 1 };

/** Where and when a person was seen. */
export interface Sighting {
  readonly region: Region;
  /** Seconds of the video. */
  readonly time: number;
}

/** The square about the whole picture. */
export function wholePicture({ width, height }: Size): Square {
  return squareAbout({ x: width / 2, y: height / 2 }, Math.max(width, height));
}

/** Sets of squares that cover a picture, the larger ones first; the squares of a set overlap by half. */
export function squaresOver(size: Size): Square[][] {
  return SIDES.map((share) => {
    const side = share * Math.min(size.width, size.height);
    return starts(size.height, side).flatMap((y) => starts(size.width, side).map((x) => ({ x, y, side })));
  });
}

/** Squares about a point, the largest first. */
export function squaresAbout(point: Point, { width, height }: Size): Square[] {
  return SIDES_ABOUT_POINT.map((share) => squareAbout(point, share * Math.min(width, height)));
}

/** The square in which a lost person is, wherever they went. */
export function squareOfReach(last: Sighting, now: number): Square {
  return squareAbout(last.region, last.region.size + 2 * reach(last, now));
}

/** Those of the persons who can have come from where one was seen last, the nearest first. */
export function withinReach(persons: readonly Person[], last: Sighting, now: number): Person[] {
  const most = reach(last, now);
  return nearestFirst(persons, last.region).filter(({ region }) => distance(region, last.region) <= most);
}

/** Those of the persons who stand at a point, the nearest first. */
export function standingAt(persons: readonly Person[], point: Point): Person[] {
  return nearestFirst(persons, point).filter(({ region }) => distance(region, point) <= region.size / 2);
}

export function nearestFirst(persons: readonly Person[], point: Point): Person[] {
  return [...persons].sort((a, b) => distance(a.region, point) - distance(b.region, point));
}

function reach({ region, time }: Sighting, now: number): number {
  return region.size * (REACH.atOnce + REACH.perSecond * (now - time));
}

function squareAbout({ x, y }: Point, side: number): Square {
  return { x: x - side / 2, y: y - side / 2, side };
}

/** Where squares of a side begin that cover a length and overlap by half. */
function starts(length: number, side: number): number[] {
  // A video of 1080 lines has squares of 1080.0000000000002 by division.
  const steps = Math.ceil((length - side) / (side / 2) - 1e-6);
  if (steps <= 0) return [(length - side) / 2];
  return Array.from({ length: steps + 1 }, (_, i) => (i / steps) * (length - side));
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
