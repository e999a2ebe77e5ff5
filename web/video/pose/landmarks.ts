import { pointInPicture, type Region, regionAround } from './region';

/** Side of the landmark network's picture, pixels. */
export const LANDMARK_SIDE = 256;
/** Landmarks of a body, in MediaPipe's order. */
export const LANDMARK_COUNT = 33;
/** Landmarks behind those of the body that give the region in the next picture: middle of the hips, and edge. */
const CENTRE = 33;
const EDGE = 34;
/** Numbers of a landmark, as the graph returns it: x, y, z, visibility and presence. */
export const LANDMARK_WIDTH = 5;

/** What the landmark network saw in one picture. */
export interface Landmarks {
  /** That there is a person, 0 to 1. */
  readonly presence: number;
  /** 33 x 2, pixels of the picture. */
  readonly image: Float32Array;
  /** 33 x 3, metres, from the middle of the hips; x to the right of the picture, y down, z away from the camera. */
  readonly world: Float32Array;
  /** 33, that the landmark is in the picture and not hidden, 0 to 1. */
  readonly visibility: Float32Array;
  readonly region: Region;
  /** The region in the next picture. */
  readonly next: Region;
}

const sigmoid = (value: number): number => 1 / (1 + Math.exp(-value));

/**
 * @param landmarks 39 x 5 in pixels of the network's picture, as the graph returns them; visibility as a logit
 * @param world 39 x 3 in metres
 * @param region what the network saw
 */
export function landmarksOf(
  { landmarks, world, presence }: Readonly<Record<'landmarks' | 'world' | 'presence', Float32Array>>,
  region: Region,
): Landmarks {
  const point = (i: number): { x: number; y: number } =>
    pointInPicture(
      region,
      landmarks[i * LANDMARK_WIDTH]! / LANDMARK_SIDE,
      landmarks[i * LANDMARK_WIDTH + 1]! / LANDMARK_SIDE,
    );
  const image = new Float32Array(LANDMARK_COUNT * 2);
  const turned = new Float32Array(LANDMARK_COUNT * 3);
  const visibility = new Float32Array(LANDMARK_COUNT);
  const [cos, sin] = [Math.cos(region.angle), Math.sin(region.angle)];
  for (let i = 0; i < LANDMARK_COUNT; i++) {
    const { x, y } = point(i);
    image.set([x, y], 2 * i);
    const [a, b] = [world[3 * i]!, world[3 * i + 1]!];
    turned.set([a * cos - b * sin, a * sin + b * cos, world[3 * i + 2]!], 3 * i);
    visibility[i] = Math.min(
      sigmoid(landmarks[i * LANDMARK_WIDTH + 3]!),
      sigmoid(landmarks[i * LANDMARK_WIDTH + 4]!),
    );
  }
  return {
    presence: presence[0]!,
    image,
    world: turned,
    visibility,
    region,
    next: regionAround(point(CENTRE), point(EDGE)),
  };
}
