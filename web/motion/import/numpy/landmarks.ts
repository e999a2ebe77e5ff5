import type { Positions } from '../positions';
import { AppError } from '../../../common/error';
import { distance, readVec } from '../../math/vec3';

const FACE = ['nose', 'left_eye', 'right_eye', 'left_ear', 'right_ear'];
const LIMBS = ['shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle'].flatMap((part) => [
  `left_${part}`,
  `right_${part}`,
]);
/** Points of the body by their place in an array; those without a name are left out. */
type Order = readonly (string | null)[];

const COCO: Order = [...FACE, ...LIMBS];
/** COCO with feet, hands and face: toes and heels follow the body. */
const WHOLE_BODY: Order = [...COCO, 'left_big_toe', null, null, 'right_big_toe'];
/** The joints of Human3.6M: their head is its top, spine and neck are not those of a skeleton. */
const HUMAN36M: Order = [
  null,
  ...['right', 'left'].flatMap((side) => ['hip', 'knee', 'ankle'].map((part) => `${side}_${part}`)),
  null,
  null,
  'nose',
  'head',
  ...['left', 'right'].flatMap((side) => ['shoulder', 'elbow', 'wrist'].map((part) => `${side}_${part}`)),
];
/** The landmarks of MediaPipe: ears, arms without fingers, legs, and the tips of the feet. */
const MEDIAPIPE: Order = Array.from({ length: 33 }, (_, i) => {
  if (i === 0) return 'nose';
  if (i === 7 || i === 8) return FACE[i - 4]!;
  if (i >= 11 && i < 17) return LIMBS[i - 11]!;
  if (i >= 23 && i < 29) return LIMBS[i - 17]!;
  return i > 30 ? `${i === 31 ? 'left' : 'right'}_foot_index` : null;
});

/** Numbers of points that are known: MediaPipe alone and with hands and face, COCO or Human3.6M, COCO with all. */
const ORDERS: ReadonlyMap<number, Order> = new Map([
  ...[33, 75, 543, 553].map((count) => [count, MEDIAPIPE] as const),
  [17, COCO],
  [133, WHOLE_BODY],
]);
export const LANDMARK_COUNTS: readonly number[] = [...ORDERS.keys()];

/** Least depth of a body as a share of its other extents: without depth, a third value is how sure a point is. */
const MIN_DEPTH = 0.02;

/**
 * Points of a body in pictures from an array of all of them, recognised by their number. Null for another number.
 *
 * @param values frames x count x 3
 * @throws {AppError} `not-motion` for points without depth
 */
export function landmarksIn(values: ArrayLike<number>, count: number): Positions | null {
  const known = ORDERS.get(count);
  if (!known) return null;
  const all = Float32Array.from(values);
  const order = known === COCO && !hasFaceFirst(all) ? HUMAN36M : known;
  const at = order.flatMap((name, index) => (name === null ? [] : [{ name, index }]));
  const frames = all.length / (3 * count);
  const places = new Float32Array(frames * at.length * 3);
  for (let frame = 0; frame < frames; frame++)
    at.forEach(({ index }, to) => {
      const from = (frame * count + index) * 3;
      places.set(all.subarray(from, from + 3), (frame * at.length + to) * 3);
    });
  const joints = at.map(({ name }) => ({ name, parent: -1 }));
  if (isFlat({ joints, places })) throw noDepth();
  return { joints, places };
}

/** Whether the first five of 17 points are a face, nearer to one another than the next two, the shoulders. */
function hasFaceFirst(places: Float32Array): boolean {
  for (let first = 0; first + COCO.length <= places.length / 3; first += COCO.length) {
    const at = (point: number) => readVec(places, first + point);
    const face = Math.max(...[1, 2, 3, 4].map((point) => distance(at(0), at(point))));
    const shoulders = distance(at(5), at(6));
    if (Number.isFinite(face + shoulders)) return face < shoulders;
  }
  return true;
}

/** Whether the bodies of all frames have hardly any depth. */
function isFlat({ joints, places }: Positions): boolean {
  const extents = [0, 0, 0];
  for (let first = 0; first < places.length; first += joints.length * 3)
    for (let axis = 0; axis < 3; axis++) {
      const row = joints.map((_, joint) => places[first + joint * 3 + axis]!).filter(Number.isFinite);
      if (row.length > 0) extents[axis] = Math.max(extents[axis]!, Math.max(...row) - Math.min(...row));
    }
  return Math.min(...extents) < MIN_DEPTH * Math.max(...extents);
}

function noDepth(): AppError {
  return new AppError(
    'not-motion',
    'The points in this file have no depth: they are places in a picture.',
    'Use points in 3D. A video of one dancer can be dropped itself.',
  );
}
