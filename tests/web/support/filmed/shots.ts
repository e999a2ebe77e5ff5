/** The videos that the accuracy of the motion from a video is measured with. */

/** A camera that looks at a point; metres, y up. */
export interface Shot {
  readonly width: number;
  readonly height: number;
  /** Focal length, pixels. */
  readonly focal: number;
  readonly position: readonly [number, number, number];
  readonly target: readonly [number, number, number];
  readonly fps: number;
  readonly clothed: boolean;
  /** By how much a hand turns the camera to both sides, slowly, degrees; it trembles meanwhile. By default it stands still. */
  readonly panned?: number;
  /** From a time in seconds on, the camera is elsewhere. */
  readonly cut?: Pick<Shot, 'position' | 'target'> & { readonly at: number };
  /** Bits a second; by default as many as a good picture takes. */
  readonly bitrate?: number;
  /** Clockwise turn that players are told to apply to the pictures, degrees. */
  readonly rotation?: 0 | 90 | 180 | 270;
}

export type MotionName = 'salsa' | 'slow' | 'turning' | 'spinning' | 'walking' | 'balancing';

/** A video whose motion is known. */
export interface FilmedMotion {
  /** Name of its recording in tests/fixtures/video. */
  readonly name: string;
  readonly motion: MotionName;
  readonly title: string;
  readonly seconds: number;
  readonly shot: Shot;
}

const LOW = 0.6;
const CHEST = 1.3;
const HIGH = 2.2;

function filmed(
  motion: MotionName,
  title: string,
  seconds: number,
  height: number,
  depth: number,
  panned?: number,
): FilmedMotion {
  return {
    name: `mannequin/${motion}-${height.toFixed(1)}${panned === undefined ? '' : '-panned'}`,
    motion,
    title,
    seconds,
    shot: {
      width: 480,
      height: 360,
      focal: 430,
      position: [0.3, height, 3.5],
      target: [0, 0.9, -depth],
      fps: 20,
      clothed: true,
      ...(panned !== undefined && { panned }),
    },
  };
}

/** Videos of our own mannequin. */
export const FILMED: readonly FilmedMotion[] = [
  ...[LOW, CHEST, HIGH].map((height) => filmed('salsa', 'salsa', 6, height, 0)),
  ...[LOW, CHEST, HIGH].map((height) => filmed('turning', 'turning, 0.45 turns a second', 6, height, 0)),
  filmed('spinning', 'turning, 0.9 turns a second', 4, CHEST, 0),
  ...[LOW, CHEST, HIGH].map((height) => filmed('walking', 'walking away and back', 6, height, 0.7)),
  filmed('salsa', 'salsa, camera in a hand, turned by 12°', 6, CHEST, 0, 12),
  filmed('walking', 'walking away and back, camera in a hand, turned by 12°', 6, CHEST, 0.7, 12),
];

function person(view: number, side: string, shot: Pick<Shot, 'position' | 'target' | 'focal'>): FilmedMotion {
  return {
    name: `person/${view}`,
    motion: 'balancing',
    title: `a person balancing, from ${side}`,
    seconds: 1.6,
    shot: { width: 1080, height: 1920, fps: 30, clothed: true, ...shot },
  };
}

/**
 * Videos of a person, filmed by four cameras at once: 1.6 seconds of a step on a line on the floor, bent far to the side on
 * one leg. From the demonstration of Pose2Sim 0.10.49 (`Demo_SinglePerson`, BSD-3-Clause,
 * David Pagnon and others) and its calibration; the truth is what our networks saw in all four pictures, triangulated.
 */
export const PERSON: readonly FilmedMotion[] = [
  person(1, 'the front left', { position: [-1.91, 1.9, 1.46], target: [-0.14, 0.75, -0.67], focal: 1681 }),
  person(2, 'the front', { position: [0.71, 1.69, 2.58], target: [0.11, 0.75, -0.2], focal: 1674 }),
  person(3, 'behind right', { position: [2.23, 2.09, -3.22], target: [0.25, 0.83, -1.35], focal: 1682 }),
  person(4, 'behind left', { position: [-1.42, 1.88, -3.76], target: [-0.16, 0.77, -1.27], focal: 1675 }),
];
