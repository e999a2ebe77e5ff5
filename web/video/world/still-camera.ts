import {
  aboutAxis,
  angleOf,
  between,
  conjugate,
  meanQuat,
  multiply,
  normaliseQuat,
  type Quat,
  readQuat,
  rotate,
} from '../../motion/math/quat';
import { direction, readVec, writeVec, Z_AXIS } from '../../motion/math/vec3';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { DEFAULT_FOCAL, lookingAt } from './camera';
import type { Series } from './series';

/** A camera that never turns by more than this stands still; what is measured of it is noise. Radians. */
const STILL = 0.02;
/** Least cosine of the angle between where the camera looks and a landmark. */
const MIN_COSINE = 0.1;

/**
 * What a camera that stands still would have seen: landmarks are where the rays through them meet the picture of a
 * camera that looks where this one looked on average, and those in metres are turned with it. The same where the camera
 * hardly turned.
 * @param focal pixels
 */
export function asOfStillCamera(series: Series, focal: number): Series {
  const { width, height } = series;
  if (turnedBy(series) < STILL) return series;
  const factor = (DEFAULT_FOCAL * Math.max(width, height)) / focal;
  const turns = turnsOf(series).map((turn) => ofFocal(turn, factor));
  const back = conjugate(meanQuat(turns));
  const image = series.image.slice();
  const centre = series.centre.slice();
  const world = series.world.slice();
  turns.forEach((turn, frame) => {
    const q = multiply(back, turn);
    const looking = lookingAt(centre[2 * frame]!, centre[2 * frame + 1]!, series, focal);
    const move = (points: Float64Array, i: number): void => {
      const ray = rotate(q, [
        (points[2 * i]! - width / 2) / focal,
        (points[2 * i + 1]! - height / 2) / focal,
        1,
      ]);
      const depth = Math.max(ray[2], MIN_COSINE * Math.hypot(...ray));
      points[2 * i] = (ray[0] / depth) * focal + width / 2;
      points[2 * i + 1] = (ray[1] / depth) * focal + height / 2;
    };
    move(centre, frame);
    // The network saw the body as upright as the camera was held.
    const still = lookingAt(centre[2 * frame]!, centre[2 * frame + 1]!, series, focal);
    const held = multiply(conjugate(still), multiply(q, looking));
    for (let i = frame * LANDMARK_COUNT; i < (frame + 1) * LANDMARK_COUNT; i++) {
      move(image, i);
      writeVec(world, i, rotate(held, readVec(world, i)));
    }
  });
  return { ...series, image, centre, world };
}

/** Greatest angle between how the camera was turned on average and in a frame, radians. */
export function turnedBy(series: Pick<Series, 'turn' | 'frames'>): number {
  const turns = turnsOf(series);
  const back = conjugate(meanQuat(turns));
  return Math.max(...turns.map((turn) => angleOf(multiply(back, turn))));
}

function turnsOf({ turn, frames }: Pick<Series, 'turn' | 'frames'>): Quat[] {
  return Array.from({ length: frames }, (_, frame) => normaliseQuat(readQuat(turn, frame)));
}

/**
 * A turn that was measured with the usual focal length, as it is with another: pictures shift by as many pixels, and
 * turn about the middle by the same angle.
 * @param factor usual focal length over the other
 */
function ofFocal(turn: Quat, factor: number): Quat {
  const ahead = rotate(turn, Z_AXIS);
  const roll = multiply(conjugate(between(Z_AXIS, ahead)), turn);
  const slopes = direction([ahead[0] * factor, ahead[1] * factor, ahead[2]], Z_AXIS);
  return multiply(between(Z_AXIS, slopes), aboutAxis(Z_AXIS, 2 * Math.atan2(roll[2], roll[3])));
}
