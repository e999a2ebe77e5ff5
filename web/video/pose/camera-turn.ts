import {
  aboutAxis,
  angleOf,
  conjugate,
  IDENTITY,
  multiply,
  normaliseQuat,
  type Quat,
  rotate,
} from '../../motion/math/quat';
import { mean, median } from '../../motion/math/statistics';
import { direction, length, type Vec3, X_AXIS } from '../../motion/math/vec3';
import { type Grey, halved, withoutLocalMean } from './grey';
import type { Point, Region } from './region';

/** Longer side of the pictures that are compared, pixels. */
const SIDE = 128;
/** Steps of Gauss-Newton on the picture at a quarter of its size, at half of it, and at its own. */
const STEPS = [8, 6, 4];
/** An error that counts a quarter, over the median of all: larger ones are of what moves by itself. */
const TOLERANCE = 3;
const OWN_SIZE = STEPS.length - 1;
/** A picture lies on another where this share of its edges, strong ones more, is less than so many radians off. */
const MOST = 0.4;
const ALIGNED = 8e-4;
/** Edges in one direction say nothing where they are so few beside those in the other. */
const FEW = 0.05;
/** Grey values that mean nothing. */
const NOISE = 0.005;
/** Strength of the edges below which a picture shows nothing, such as a black one. */
const BLANK = 0.05;
/** A step shorter than this is the last one, radians. */
const CONVERGED = 5e-5;
/** Turn from which on another picture is compared with, radians: pictures must share most of what they show. */
const MAX_TURN = 0.2;
/** Weight of no turn at all, so that a wall without anything on it does not turn. */
const RIDGE = 1;
/** Radius of a dancer with stretched arms, as a share of their region's side. */
const DANCER = 0.45;
/** Pixels at the edges that are not compared. */
const BORDER = 2;

/** A part of a picture that is not compared, about the dancer; shares of the picture's longer side. */
export interface Circle extends Point {
  readonly radius: number;
}

/** @param longer the picture's longer side, pixels */
export function circleAbout({ x, y, size }: Region, longer: number): Circle {
  return { x: x / longer, y: y / longer, radius: (DANCER * size) / longer };
}

interface Compared {
  /** At the sizes of `STEPS`. */
  readonly levels: readonly Grey[];
  readonly dancer: Circle | null;
}

/** The pixels of a picture that a key shows, too. */
interface Differences {
  /** Grey value of the key less the picture's. */
  readonly errors: Float64Array;
  /** How the key's value changes with a small rotation vector, three a pixel. */
  readonly rows: Float64Array;
}

/** Of the edges in one direction, weighted by the square of their strength. */
interface Share {
  readonly aligned: number;
  readonly all: number;
}

interface Key extends Compared {
  /** From the axes of this picture's camera to those of the first one's. */
  readonly turn: Quat;
}

/** Size of the pictures that are compared, pixels. */
export function comparedSize(
  width: number,
  height: number,
): { readonly width: number; readonly height: number } {
  const factor = SIDE / Math.max(width, height);
  const quarters = (value: number): number => 4 * Math.max(2 * BORDER + 2, Math.round((value * factor) / 4));
  return { width: quarters(width), height: quarters(height) };
}

/**
 * How a camera that is held in a hand or follows the dancer turns, picture by picture, from what stands still in them:
 * the rotation that lays a picture best over an earlier one, by Gauss-Newton on their grey values (Lucas and Kanade
 * 1981), with weights that leave out what moves by itself (Geman and McClure 1985).
 */
export class CameraTurn {
  readonly #keys: Key[] = [];
  #turn: Quat = IDENTITY;

  /** @param focal focal length, relative to the longer side of the pictures */
  constructor(private readonly focal: number) {}

  /** The next picture has nothing in common with those before it; its camera counts as not turned since the last one. */
  restart(): void {
    this.#keys.length = 0;
  }

  /**
   * @param grey the next picture, of `comparedSize`, 0 to 1
   * @returns the turn from the axes of its camera (x right, y down, z away) to those of the first picture's
   */
  next(grey: Grey, dancer: Circle | null): Quat {
    const picture = prepared(grey, dancer);
    const key = this.#nearestKey();
    if (!key) {
      this.#keys.push({ ...picture, turn: this.#turn });
      return this.#turn;
    }
    let between = multiply(conjugate(key.turn), this.#turn);
    const laid = differences(picture, key, OWN_SIZE, between, this.focal);
    if (mean(strengthsOf(laid)) < BLANK) {
      this.#keys[this.#keys.indexOf(key)] = { ...picture, turn: this.#turn };
      return this.#turn;
    }
    if (isAligned(laid)) return this.#turn;
    STEPS.forEach((steps, level) => {
      for (let step = 0; step < steps; step++) {
        const change = turnThatFits(differences(picture, key, level, between, this.focal));
        between = normaliseQuat(multiply(turnBy(change), between));
        if (length(change) < CONVERGED) break;
      }
    });
    this.#turn = normaliseQuat(multiply(key.turn, between));
    if (angleOf(between) > MAX_TURN) this.#keys.push({ ...picture, turn: this.#turn });
    return this.#turn;
  }

  #nearestKey(): Key | undefined {
    const angle = ({ turn }: Key): number => angleOf(multiply(conjugate(turn), this.#turn));
    return this.#keys.reduce<Key | undefined>(
      (best, key) => (best && angle(best) <= angle(key) ? best : key),
      undefined,
    );
  }
}

/** A picture as it is compared. */
function prepared(grey: Grey, dancer: Circle | null): Compared {
  const whole = withoutLocalMean(grey);
  const half = halved(whole);
  return { levels: [halved(half), half, whole], dancer };
}

/** What is left between a picture and a key over which it is laid. */
function differences(
  picture: Compared,
  key: Compared,
  level: number,
  between: Quat,
  focalOfSide: number,
): Differences {
  const { width, height, values } = picture.levels[level]!;
  const before = key.levels[level]!.values;
  const longer = Math.max(width, height);
  const focal = focalOfSide * longer;
  const [middleX, middleY] = [(width - 1) / 2, (height - 1) / 2];
  const [ax, ay, az] = [rotate(between, [1, 0, 0]), rotate(between, [0, 1, 0]), rotate(between, [0, 0, 1])];
  const hidden = inside(picture.dancer, longer);
  const hiddenInKey = inside(key.dancer, longer);
  const errors = new Float64Array(width * height);
  const rows = new Float64Array(3 * errors.length);
  let count = 0;
  for (let y = BORDER; y < height - BORDER; y++)
    for (let x = BORDER; x < width - BORDER; x++) {
      if (hidden(x, y)) continue;
      const [u, v] = [(x - middleX) / focal, (y - middleY) / focal];
      const rx = ax[0] * u + ay[0] * v + az[0];
      const ry = ax[1] * u + ay[1] * v + az[1];
      const rz = ax[2] * u + ay[2] * v + az[2];
      const [p, q] = [rx / rz, ry / rz];
      const [kx, ky] = [p * focal + middleX, q * focal + middleY];
      if (!(kx >= BORDER && ky >= BORDER && kx < width - 1 - BORDER && ky < height - 1 - BORDER)) continue;
      if (hiddenInKey(kx, ky)) continue;
      const [left, top] = [Math.floor(kx), Math.floor(ky)];
      const [s, t] = [kx - left, ky - top];
      const at = top * width + left;
      const [a, b, c, d] = [before[at]!, before[at + 1]!, before[at + width]!, before[at + width + 1]!];
      const gx = ((b - a) * (1 - t) + (d - c) * t) * focal;
      const gy = ((c - a) * (1 - s) + (d - b) * s) * focal;
      errors[count] = a + (b - a) * s + (c + (d - c) * s - a - (b - a) * s) * t - values[y * width + x]!;
      // How p and q change when the ray turns by a small rotation vector.
      rows[3 * count] = gx * -p * q - gy * (1 + q * q);
      rows[3 * count + 1] = gx * (1 + p * p) + gy * p * q;
      rows[3 * count + 2] = -gx * q + gy * p;
      count++;
    }
  return { errors: errors.subarray(0, count), rows: rows.subarray(0, 3 * count) };
}

/**
 * Whether a picture lies on a key as it is. Level edges and upright ones are asked apart: long lines on a floor lie well
 * however far a camera pans.
 */
function isAligned({ errors, rows }: Differences): boolean {
  // A turn up or down moves level edges, one to the side upright ones.
  const [level, upright] = [0, 1].map((turn) => {
    const strengths = errors.map((_, i) => Math.abs(rows[3 * i + turn]!));
    const typical = mean(strengths);
    let [aligned, all] = [0, 0];
    strengths.forEach((strength, i) => {
      if (strength <= typical) return;
      all += strength ** 2;
      const tolerance = ALIGNED * Math.hypot(rows[3 * i]!, rows[3 * i + 1]!) + NOISE;
      if (Math.abs(errors[i]!) < tolerance) aligned += strength ** 2;
    });
    return { aligned, all };
  }) as [Share, Share];
  const most = Math.max(level.all, upright.all);
  return [level, upright].every(({ aligned, all }) => aligned >= MOST * all || all < FEW * most);
}

/** The rotation vector by which a picture lies better: weighted least squares of rows x change = -errors. */
function turnThatFits(differences: Differences): Vec3 {
  const { errors, rows } = differences;
  // Where edges are: elsewhere a picture lies well anywhere.
  const strengths = strengthsOf(differences);
  const typical = mean(strengths);
  const sizes = errors.filter((_, i) => strengths[i]! > typical).map(Math.abs);
  const scale = (sizes.length > 0 ? TOLERANCE * median(sizes) : 0) + NOISE;
  let [xx, xy, xz, yy, yz, zz] = [RIDGE, 0, 0, RIDGE, 0, RIDGE];
  let [bx, by, bz] = [0, 0, 0];
  errors.forEach((error, i) => {
    const weight = 1 / (1 + (error / scale) ** 2) ** 2;
    const [x, y, z] = [rows[3 * i]!, rows[3 * i + 1]!, rows[3 * i + 2]!];
    xx += weight * x * x;
    xy += weight * x * y;
    xz += weight * x * z;
    yy += weight * y * y;
    yz += weight * y * z;
    zz += weight * z * z;
    bx -= weight * x * error;
    by -= weight * y * error;
    bz -= weight * z * error;
  });
  // By the adjugate.
  const [a, b, c] = [yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy];
  const [e, f, g] = [xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy];
  const determinant = xx * a + xy * b + xz * c;
  return [
    (a * bx + b * by + c * bz) / determinant,
    (b * bx + e * by + f * bz) / determinant,
    (c * bx + f * by + g * bz) / determinant,
  ];
}

/** Changes of grey value a radian. */
function strengthsOf({ errors, rows }: Differences): Float64Array {
  return errors.map((_, i) => Math.hypot(rows[3 * i]!, rows[3 * i + 1]!));
}

/** Whether a pixel is in a circle. */
function inside(circle: Circle | null, longer: number): (x: number, y: number) => boolean {
  if (!circle) return () => false;
  const [x0, y0, square] = [circle.x * longer, circle.y * longer, (circle.radius * longer) ** 2];
  return (x, y) => (x - x0) ** 2 + (y - y0) ** 2 < square;
}

const turnBy = (change: Vec3): Quat => aboutAxis(direction(change, X_AXIS), length(change));
