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
import { direction, type Vec3, writeVec, X_AXIS, Y_AXIS, Z_AXIS } from '../../../../web/motion/math/vec3';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';
import { DEFAULT_FOCAL, lookingAt, toCameraAxes } from '../../../../web/video/world/camera';
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
function seen(most: number, focal: number): { series: Series; still: Float64Array; body: Float64Array } {
  const image = new Float64Array(FRAMES * LANDMARK_COUNT * 2);
  const still = image.slice();
  const world = new Float64Array(FRAMES * LANDMARK_COUNT * 3);
  const body = world.slice();
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
    // The network looks straight at the first landmark, and sees a body in metres about it.
    const [x, y] = [image[2 * frame * LANDMARK_COUNT]!, image[2 * frame * LANDMARK_COUNT + 1]!];
    const looking = lookingAt(x, y, { width: WIDTH, height: HEIGHT }, focal);
    for (let i = 0; i < LANDMARK_COUNT; i++) {
      const metres: Vec3 = [0.02 * i - 0.3, 0.8 - 0.05 * i, 0.1 * Math.sin(i)];
      const at = frame * LANDMARK_COUNT + i;
      writeVec(world, at, rotate(conjugate(multiply(q, looking)), metres));
      writeVec(body, at, rotate(conjugate(middle), metres));
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
    world,
    visibility: new Float64Array(0),
    centre: Float64Array.from(
      { length: 2 * FRAMES },
      (_, i) => image[2 * LANDMARK_COUNT * (i >> 1) + (i % 2)]!,
    ),
    turn,
    seen: new Uint8Array(FRAMES).fill(1),
    gaps: [],
  };
  return { series, still, body };
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
    const { series, still, body } = seen(0.25, focal * WIDTH);
    const found = asOfStillCamera(series, focal * WIDTH);
    const { image, centre } = found;
    image.forEach((value, i) => expect(Math.abs(value - still[i]!)).toBeLessThan(0.5));
    centre.forEach((value, i) => {
      const first = 2 * LANDMARK_COUNT * (i >> 1) + (i % 2);
      expect(Math.abs(value - still[first]!)).toBeLessThan(0.5);
    });
    const inCamera = toCameraAxes(found, focal * WIDTH);
    inCamera.forEach((value, i) => expect(Math.abs(value - body[i]!)).toBeLessThan(0.002));
    expect(turnedBy(series)).toBeGreaterThan(0.15);
  },
);

it('leaves what a camera saw that hardly turned', () => {
  const { series } = seen(0.01, DEFAULT_FOCAL * WIDTH);
  expect(asOfStillCamera(series, DEFAULT_FOCAL * WIDTH)).toBe(series);
});
