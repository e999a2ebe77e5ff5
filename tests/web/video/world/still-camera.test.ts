import { expect, it } from 'vitest';
import {
  aboutAxis,
  conjugate,
  meanQuat,
  multiply,
  type Quat,
  rotate,
  writeQuat,
} from '../../../../web/motion/math/quat';
import { direction, type Vec3, X_AXIS, Y_AXIS, Z_AXIS } from '../../../../web/motion/math/vec3';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';
import { DEFAULT_FOCAL } from '../../../../web/video/world/camera';
import type { Series } from '../../../../web/video/world/series';
import { asOfStillCamera, turnedBy } from '../../../../web/video/world/still-camera';

const FRAMES = 41;
const [WIDTH, HEIGHT] = [1280, 720];

/** To the side as sin, and back; about the middle meanwhile. */
const turnAt = (frame: number, most: number): Quat => {
  const wave = Math.sin((2 * Math.PI * frame) / (FRAMES - 1));
  return multiply(
    aboutAxis(Y_AXIS, most * wave),
    multiply(aboutAxis(X_AXIS, 0.1 * most * wave), aboutAxis(Z_AXIS, 0.3 * most * wave)),
  );
};

/** Landmarks in front of a camera that turns by radians, with a focal length in pixels. */
function seen(most: number, focal: number): { series: Series; still: Float64Array } {
  const image = new Float64Array(FRAMES * LANDMARK_COUNT * 2);
  const still = image.slice();
  const turn = new Float64Array(FRAMES * 4);
  const project = ([x, y, z]: Vec3): [number, number] => [
    (x / z) * focal + WIDTH / 2,
    (y / z) * focal + HEIGHT / 2,
  ];
  const turns = Array.from({ length: FRAMES }, (_, frame) => turnAt(frame, most));
  const middle = meanQuat(turns);
  turns.forEach((q, frame) => {
    for (let i = 0; i < LANDMARK_COUNT; i++) {
      const point: Vec3 = [0.02 * frame - 0.4 + 0.01 * i, 1.2 - 0.05 * i, 4];
      const at = 2 * (frame * LANDMARK_COUNT + i);
      image.set(project(rotate(conjugate(q), point)), at);
      still.set(project(rotate(conjugate(middle), point)), at);
    }
    // As it is measured with the usual focal length: slopes are in proportion.
    const ahead = rotate(q, Z_AXIS);
    const factor = focal / (DEFAULT_FOCAL * WIDTH);
    const tilt = direction([ahead[0] * factor, ahead[1] * factor, ahead[2]], Z_AXIS);
    writeQuat(turn, frame, multiply(swing(tilt), multiply(conjugate(swing(ahead)), q)));
  });
  const series = {
    width: WIDTH,
    height: HEIGHT,
    frames: FRAMES,
    start: 0,
    image,
    world: new Float64Array(0),
    visibility: new Float64Array(0),
    centre: Float64Array.from(
      { length: 2 * FRAMES },
      (_, i) => image[2 * LANDMARK_COUNT * (i >> 1) + (i % 2)]!,
    ),
    turn,
    seen: new Uint8Array(FRAMES).fill(1),
    gaps: [],
  };
  return { series, still };
}

/** The rotation of Z to a direction without a twist. */
function swing([x, y, z]: Vec3): Quat {
  const angle = Math.acos(z);
  const size = Math.hypot(x, y);
  return size > 0 ? aboutAxis([-y / size, x / size, 0], angle) : [0, 0, 0, 1];
}

it.each([DEFAULT_FOCAL, 1.3])(
  'shows landmarks as if the camera had not turned, with a focal length of %f',
  (focal) => {
    const { series, still } = seen(0.25, focal * WIDTH);
    const { image, centre } = asOfStillCamera(series, focal * WIDTH);
    image.forEach((value, i) => expect(Math.abs(value - still[i]!)).toBeLessThan(0.5));
    centre.forEach((value, i) => {
      const first = 2 * LANDMARK_COUNT * (i >> 1) + (i % 2);
      expect(Math.abs(value - still[first]!)).toBeLessThan(0.5);
    });
    expect(turnedBy(series)).toBeGreaterThan(0.15);
  },
);

it('leaves what a camera saw that hardly turned', () => {
  const { series } = seen(0.01, DEFAULT_FOCAL * WIDTH);
  expect(asOfStillCamera(series, DEFAULT_FOCAL * WIDTH)).toBe(series);
});
