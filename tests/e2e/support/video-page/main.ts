/** Films mannequins and reads the videos, for tests and measurements. */
import { type Cast, film, type VideoFormat, written } from './film';
import { motionOf } from '../../../web/support/filmed/motions';
import type { MotionName, Shot } from '../../../web/support/filmed/shots';
import { openVideo } from '../../../../web/video/frames';
import { Recorder } from '../../../../web/video/observations';
import { loadPoseGraphs } from '../../../../web/video/pose/graphs';
import { PersonTracker } from '../../../../web/video/pose/tracker';

const plain = (array: ArrayLike<number>): number[] => Array.from(array);

async function base64(file: Blob): Promise<string> {
  const bytes = new Uint8Array(await file.arrayBuffer());
  let text = '';
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
}

const page = {
  /** A video, as base64. */
  async film(motion: MotionName, shot: Shot, seconds: number, format?: VideoFormat): Promise<string> {
    return base64(await film([{ motion: motionOf(motion) }], shot, seconds, format));
  },
  /** A video of the same dancer several times, each in another place or at other times. */
  async filmSeveral(
    motion: MotionName,
    shot: Shot,
    seconds: number,
    cast: readonly Omit<Cast, 'motion'>[],
  ): Promise<string> {
    const all = cast.map((place): Cast => ({ ...place, motion: motionOf(motion) }));
    return base64(await film(all, shot, seconds));
  },
  /** A video of one colour. */
  async blank(colour: string, seconds: number, format: VideoFormat): Promise<string> {
    const canvas = Object.assign(document.createElement('canvas'), { width: 160, height: 120 });
    const context = canvas.getContext('2d')!;
    const draw = (): void => {
      context.fillStyle = colour;
      context.fillRect(0, 0, canvas.width, canvas.height);
    };
    return base64(await written(canvas, draw, { fps: 10, seconds }, format));
  },
  truth: (motion: MotionName) => plain(motionOf(motion).positions),
  async read(base64: string) {
    const file = new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]);
    const graphs = await loadPoseGraphs(
      new URL('/models/pose/pose.json', location.href).href,
      globalThis,
      () => undefined,
    );
    const video = await openVideo(file);
    const tracker = new PersonTracker(graphs, null);
    const recorder = new Recorder(video.width, video.height);
    const begin = performance.now();
    for await (const { time, picture } of video.pictures(0, Infinity))
      recorder.add(time, picture, await tracker.next(picture, time));
    const seconds = (performance.now() - begin) / 1000;
    video.close();
    const o = recorder.observations();
    return {
      seconds,
      width: o.width,
      height: o.height,
      times: plain(o.times),
      presence: plain(o.presence),
      image: plain(o.image),
      world: plain(o.world),
      visibility: plain(o.visibility),
      centre: plain(o.centre),
      turn: plain(o.turn),
    };
  },
};

export type Page = typeof page;
Object.assign(globalThis, { video: page });
