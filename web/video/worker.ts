/** Reads videos and makes motions of what was seen, off the main thread. */
import { serve, type TaskContext } from '../common/serve-tasks';
import { AppError } from '../common/error';
import { yieldToEvents } from '../common/yield-to-events';
import { writeBvh } from '../motion/bvh/write';
import { checkSeen } from './checks';
import { openVideo, type VideoFile } from './frames';
import { type Observations, Recorder } from './observations';
import { loadPoseGraphs, type PoseGraphs } from './pose/graphs';
import { bodyBox } from './pose/detector';
import type { Picture } from './pose/picture';
import { PersonTracker, type PersonPick, type Tracked } from './pose/tracker';
import { adviceOn, confidenceOf } from './world/advice';
import { type WorldOptions, reconstruct } from './world/reconstruct';
import type { Part } from './world/series';
import { adviceOnCuts, longestShot } from './world/shots';

export interface ReadRequest {
  readonly file: Blob;
  /** Absolute address of pose.json. */
  readonly graphs: string;
  /** Who is followed, and from when on; null takes the largest in the first picture with people. */
  readonly pick: PersonPick | null;
  /** How the motions of what has been read so far are made; all of that is used. */
  readonly options: Omit<WorldOptions, 'trim'>;
}

/** The people in the picture of a moment. */
export interface People {
  /** Of the picture, seconds of the video. */
  readonly time: number;
  /** About where each is, the largest first: left, top, right and bottom in pixels of the video. */
  readonly boxes: readonly (readonly [number, number, number, number])[];
  /** The picture, small. */
  readonly image: ImageBitmap;
}

/** What happens while a video is being read; times as in `VideoFile`. */
export type ReadReport =
  /** Share of the networks that is downloaded, 0 to 1. */
  | { readonly kind: 'networks'; readonly fraction: number }
  | {
      readonly kind: 'opened';
      readonly start: number;
      readonly end: number;
      readonly last: number;
      readonly width: number;
      readonly height: number;
      readonly soundStart: number | null;
    }
  /** Several people, of whom one can be picked. */
  | ({ readonly kind: 'persons' } & People)
  /** A small picture of a moment for the timeline. */
  | { readonly kind: 'thumbnail'; readonly time: number; readonly image: ImageBitmap }
  /** The newest picture, small, its time, and 33 x 2 landmarks in pixels of the video where the person is seen. */
  | {
      readonly kind: 'picture';
      readonly time: number;
      readonly landmarks: Float32Array | null;
      readonly image: ImageBitmap;
    }
  /** The motion of all that has been read so far. */
  | { readonly kind: 'part'; readonly motion: VideoMotion };

export interface SolveRequest {
  readonly observations: Observations;
  readonly options: WorldOptions;
}

/** A motion from a video. */
export interface VideoMotion {
  /** As a BVH file. */
  readonly bvh: string;
  /** Time of its first frame, seconds of the video. */
  readonly start: number;
  /** The part of the video that was used; null is all of it. */
  readonly used: Part | null;
  /** How far the camera was from the dancer, metres, with this focal length (see `WorldOptions`). */
  readonly camera: { readonly distance: number; readonly focal: number };
  /** How sure each frame is, 0 to 1. */
  readonly confidence: Float32Array;
  /** What to film better. */
  readonly advice: readonly string[];
}

/** Pictures for the timeline: as many over the whole video, and seconds between two, at the least. */
const THUMBNAILS = { most: 80, spacing: 0.5 };
/** Heights of small pictures, pixels. */
const THUMBNAIL_HEIGHT = 48;
const SHOWN_HEIGHT = 270;
/** Least time between two reports of pictures. */
const REPORT_INTERVAL_MS = 200;
/** Seconds of video after which the motion is made for the first time, and again after so many times as many. */
const PART = { first: 2, growth: 3 };

async function read(
  { file, graphs: list, pick, options }: ReadRequest,
  { signal, report }: TaskContext<ReadReport>,
): Promise<Observations> {
  const video = await openVideo(file);
  try {
    const { start, end, last, width, height, soundStart } = video;
    void report({ kind: 'opened', start, end, last, width, height, soundStart });
    const graphs = await poseGraphs(list, (fraction) => {
      void report({ kind: 'networks', fraction });
    });
    const tracker = new PersonTracker(graphs, pick);
    const recorder = new Recorder(width, height);
    const reportPicture = pictureReports(video, pick, report);
    const isPart = partTimes(pick?.time ?? start);
    for await (const { time, picture } of video.pictures(pick?.time ?? 0, Infinity)) {
      const tracked = await tracker.next(picture, time);
      recorder.add(time, picture, tracked);
      reportPicture(time, picture, tracked);
      if (isPart(time)) {
        const motion = motionSoFar(recorder.observations(), options);
        if (motion) void report({ kind: 'part', motion });
      }
      await yieldToEvents(signal);
    }
    const observations = recorder.observations();
    checkSeen(observations);
    return observations;
  } finally {
    video.close();
  }
}

/**
 * Reports what is seen while a video is read: small pictures for the timeline, once that there are several people, and
 * now and then the newest picture.
 */
function pictureReports(
  { start, end, width, height }: VideoFile,
  pick: PersonPick | null,
  report: TaskContext<ReadReport>['report'],
): (time: number, picture: Picture, tracked: Tracked) => void {
  const thumbnails = new Shrinker(width / height, THUMBNAIL_HEIGHT);
  const shown = new Shrinker(width / height, Math.min(height, SHOWN_HEIGHT));
  const isThumbnail = thumbnailTimes(end - start);
  let reported = 0;
  // Who was picked is not asked about again.
  let asked = pick !== null;
  return (time, picture, { persons, landmarks }) => {
    if (isThumbnail(time)) void report({ kind: 'thumbnail', time, image: thumbnails.of(picture) });
    if (!asked && persons.length > 0) {
      asked = true;
      const boxes = persons.map(bodyBox);
      if (boxes.length > 1) void report({ kind: 'persons', time, boxes, image: shown.of(picture) });
    }
    if (performance.now() - reported > REPORT_INTERVAL_MS) {
      reported = performance.now();
      const seen = landmarks?.image.slice() ?? null;
      void report({ kind: 'picture', time, landmarks: seen, image: shown.of(picture) });
    }
  };
}

/** True for the pictures at which the motion so far is made: ever more seldom, since it takes longer each time. */
function partTimes(from: number): (time: number) => boolean {
  let next = from + PART.first;
  return (time) => {
    if (time < next) return false;
    next = from + PART.growth * (next - from);
    return true;
  };
}

interface PeopleRequest extends Pick<ReadRequest, 'file' | 'graphs'> {
  /** Seconds of the video. */
  readonly time: number;
}

/** Who could be followed from a moment on; null after the end of the video. */
async function people({ file, graphs: list, time }: PeopleRequest): Promise<People | null> {
  const video = await openVideo(file);
  const pictures = video.pictures(time, Infinity);
  try {
    const graphs = await poseGraphs(list, () => undefined);
    const first = await pictures.next();
    if (first.done) return null;
    const { time: shownAt, picture } = first.value;
    const { width, height } = picture;
    const { persons } = await new PersonTracker(graphs, null).next(picture, shownAt);
    const image = new Shrinker(width / height, Math.min(height, SHOWN_HEIGHT)).of(picture);
    return { time: shownAt, boxes: persons.map(bodyBox), image };
  } finally {
    await pictures.return(undefined);
    video.close();
  }
}

let graphs: Promise<PoseGraphs> | null = null;

/** The networks, which are opened once. */
function poseGraphs(list: string, onProgress: (fraction: number) => void): Promise<PoseGraphs> {
  graphs ??= loadPoseGraphs(list, globalThis, onProgress).catch((error: unknown) => {
    graphs = null;
    throw error;
  });
  return graphs;
}

/** Makes small pictures of those of a video. */
class Shrinker {
  readonly #context: OffscreenCanvasRenderingContext2D;

  /** @param aspect width / height of the video */
  constructor(aspect: number, height: number) {
    this.#context = new OffscreenCanvas(Math.max(1, Math.round(height * aspect)), height).getContext('2d')!;
  }

  of(picture: Picture): ImageBitmap {
    const { canvas } = this.#context;
    this.#context.setTransform(canvas.width / picture.width, 0, 0, canvas.height / picture.height, 0, 0);
    picture.draw(this.#context);
    return canvas.transferToImageBitmap();
  }
}

/** True for the pictures of a video, evenly over its time, that are shown on the timeline. */
function thumbnailTimes(duration: number): (time: number) => boolean {
  const spacing = Math.max(THUMBNAILS.spacing, duration / THUMBNAILS.most);
  let last = -Infinity;
  return (time) => {
    if (time - last < spacing) return false;
    last = time;
    return true;
  };
}

/** Null while too little was seen: more pictures may change that, so nothing is refused before the end of the video. */
function motionSoFar(observations: Observations, options: ReadRequest['options']): VideoMotion | null {
  try {
    checkSeen(observations);
    return solve({ observations, options: { ...options, trim: null } });
  } catch (error) {
    if (error instanceof AppError) return null;
    throw error;
  }
}

/** Where no part was chosen, of a video with cuts the longest part without one is used. */
function solve({ observations, options }: SolveRequest): VideoMotion {
  const used = options.trim ?? longestShot(observations);
  const result = reconstruct(observations, { ...options, trim: used });
  return {
    bvh: writeBvh(result.motion),
    start: result.series.start,
    used,
    camera: { distance: result.distance, focal: options.focal },
    confidence: confidenceOf(result.series),
    advice: [...adviceOnCuts(observations.cuts, used), ...adviceOn(result.series, result.flipped)],
  };
}

const tasks = { read, people, solve };
export type VideoTasks = typeof tasks;

serve(tasks);
