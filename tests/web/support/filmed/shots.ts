/** The videos of our own mannequin that the accuracy of the motion from a video is measured with. */

/** A camera that stands still and looks at a point; metres, y up. */
export interface Shot {
  readonly width: number;
  readonly height: number;
  /** Focal length, pixels. */
  readonly focal: number;
  readonly position: readonly [number, number, number];
  readonly target: readonly [number, number, number];
  readonly fps: number;
  readonly clothed: boolean;
  /** Bits a second; by default as many as a good picture takes. */
  readonly bitrate?: number;
  /** Clockwise turn that players are told to apply to the pictures, degrees. */
  readonly rotation?: 0 | 90 | 180 | 270;
}

export type MotionName = 'salsa' | 'slow' | 'turning' | 'spinning' | 'walking';

/** A video whose motion is known. */
export interface FilmedMotion {
  /** Name of its recording. */
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
): FilmedMotion {
  return {
    name: `${motion}-${height.toFixed(1)}`,
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
    },
  };
}

export const FILMED: readonly FilmedMotion[] = [
  ...[LOW, CHEST, HIGH].map((height) => filmed('salsa', 'salsa', 6, height, 0)),
  ...[LOW, CHEST, HIGH].map((height) => filmed('turning', 'turning, 0.45 turns a second', 6, height, 0)),
  filmed('spinning', 'turning, 0.9 turns a second', 4, CHEST, 0),
  ...[LOW, CHEST, HIGH].map((height) => filmed('walking', 'walking away and back', 6, height, 0.7)),
];
