import { describe, expect, it } from 'vitest';
import {
  aboutAxis,
  angleOf,
  conjugate,
  IDENTITY,
  multiply,
  type Quat,
  rotate,
} from '../../../../web/motion/math/quat';
import { X_AXIS, Y_AXIS, Z_AXIS } from '../../../../web/motion/math/vec3';
import { CameraTurn, circleAbout, comparedSize } from '../../../../web/video/pose/camera-turn';
import type { Grey } from '../../../../web/video/pose/grey';
import { noise } from '../../support/skeletons';

const FOCAL = 0.9;
const DEGREE = Math.PI / 180;
const size = comparedSize(1920, 1080);
const dancer = circleAbout({ x: 960, y: 540, size: 860, angle: 0 }, 1920);
const draw = noise(5);

/** Grey values of a room by the slopes of rays, across and down. */
const walls = (u: number, v: number): number =>
  Math.sin(31 * u + 4) * Math.cos(27 * v) + Math.sin(23 * v + 13 * u) + Math.sin(53 * u - 9 * v);
const floorboards = (u: number, v: number): number => 2 * Math.sin(60 * v) + Math.sin(41 * u);

/** What a camera that is turned so sees of a room, with a dancer who moves and the noise of a sensor. */
function picture(turn: Quat, time: number, brightness = 1, room = walls): Grey {
  const { width, height } = size;
  const focal = FOCAL * Math.max(width, height);
  const values = Float32Array.from({ length: width * height }, (_, i) => {
    const [x, y] = [(i % width) - (width - 1) / 2, Math.floor(i / width) - (height - 1) / 2];
    const [a, b, c] = rotate(turn, [x / focal, y / focal, 1]);
    const [u, v] = [a / c, b / c];
    const moving = Math.hypot(x, y) < 22 ? Math.sin(0.4 * x + 9 * time) : 0;
    return brightness * (0.5 + 0.1 * room(u, v) + 0.2 * moving + 0.004 * draw());
  });
  return { width, height, values };
}

/** Turns to the side, up and about the middle, degrees. */
const turned = (yaw: number, pitch: number, roll: number): Quat =>
  multiply(
    aboutAxis(Y_AXIS, yaw * DEGREE),
    multiply(aboutAxis(X_AXIS, pitch * DEGREE), aboutAxis(Z_AXIS, roll * DEGREE)),
  );

const error = (a: Quat, b: Quat): number => angleOf(multiply(conjugate(a), b)) / DEGREE;

describe('the turn of a camera', () => {
  it('is found to a fifth of a degree while it pans, trembles and rolls, and is back where it was', () => {
    const camera = new CameraTurn(FOCAL);
    const wave = (frames: number, frame: number): number => Math.sin((2 * Math.PI * frame) / frames);
    const errors: number[] = [];
    for (let frame = 0; frame <= 120; frame++) {
      const truth = turned(
        24 * wave(120, frame) + 0.4 * wave(13, frame),
        2 * wave(60, frame),
        1.5 * wave(40, frame),
      );
      errors.push(error(camera.next(picture(truth, frame / 30), dancer), truth));
    }
    expect(Math.max(...errors)).toBeLessThan(0.5);
    expect(errors.reduce((sum, value) => sum + value, 0) / errors.length).toBeLessThan(0.2);
    expect(errors.at(-1)).toBeLessThan(0.2);
  });

  it('is found along the lines of a floor, which lie well however far it pans', () => {
    const camera = new CameraTurn(FOCAL);
    for (const yaw of [0, 0.25, 0.5, 1, 2]) {
      const found = camera.next(picture(turned(yaw, 0, 0), yaw, 1, floorboards), dancer);
      expect(error(found, turned(yaw, 0, 0))).toBeLessThan(0.2);
    }
  });

  it('is none at all of a camera that stands still, whatever the dancer does and the light', () => {
    const camera = new CameraTurn(FOCAL);
    for (let frame = 0; frame < 20; frame++)
      expect(camera.next(picture(IDENTITY, frame / 30, 1 - 0.004 * frame), dancer)).toEqual(IDENTITY);
  });

  it('begins with the first picture in which anything is seen', () => {
    const camera = new CameraTurn(FOCAL);
    for (let frame = 0; frame < 3; frame++)
      camera.next({ ...size, values: new Float32Array(size.width * size.height) }, null);
    const start = turned(10, 0, 0);
    expect(camera.next(picture(start, 0), dancer)).toEqual(IDENTITY);
    const found = camera.next(picture(turned(12, 0, 0), 0.1), dancer);
    expect(error(found, turned(2, 0, 0))).toBeLessThan(0.1);
  });

  it('goes on as it was after a cut to another picture', () => {
    const camera = new CameraTurn(FOCAL);
    camera.next(picture(IDENTITY, 0), dancer);
    const before = camera.next(picture(turned(4, 0, 0), 0.1), dancer);
    camera.restart();
    expect(camera.next(picture(turned(-20, 4, 0), 0.2), dancer)).toEqual(before);
    const found = camera.next(picture(turned(-17, 4, 0), 0.3), dancer);
    expect(error(found, before)).toBeCloseTo(3, 0);
  });

  it('is none where the dancer fills the picture', () => {
    const camera = new CameraTurn(FOCAL);
    const whole = circleAbout({ x: 960, y: 540, size: 6000, angle: 0 }, 1920);
    camera.next(picture(IDENTITY, 0), whole);
    expect(camera.next(picture(turned(3, 0, 0), 1), whole)).toEqual(IDENTITY);
  });
});
