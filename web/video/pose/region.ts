/** A point of a picture, pixels. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** A square of a picture, pixels; what lies outside the picture is black. */
export interface Square extends Point {
  /** Left and top edge are `x` and `y`. */
  readonly side: number;
}

/**
 * The square part of a picture that the landmark network sees, turned so that the person stands upright in it; `x` and
 * `y` are its middle.
 */
export interface Region extends Point {
  /** Side, pixels. */
  readonly size: number;
  /** Angle of the person to the vertical of the picture, radians, clockwise. */
  readonly angle: number;
}

/** A circle about a whole person is this much smaller than the region's side. */
const MARGIN = 1.25;

/**
 * The region of a person from two alignment points, as MediaPipe's AlignmentPointsRectsCalculator does it.
 * @param centre middle of the hips, pixels
 * @param edge a point above the head, on the circle about the whole person
 */
export function regionAround(centre: Point, edge: Point): Region {
  const [dx, dy] = [edge.x - centre.x, edge.y - centre.y];
  return { ...centre, size: 2 * Math.hypot(dx, dy) * MARGIN, angle: Math.atan2(dx, -dy) };
}

/** The point of the picture, in pixels, at a place in the region; both coordinates are shares of its side. */
export function pointInPicture({ x, y, size, angle }: Region, across: number, down: number): Point {
  const [dx, dy] = [(across - 0.5) * size, (down - 0.5) * size];
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return { x: x + dx * cos - dy * sin, y: y + dx * sin + dy * cos };
}
