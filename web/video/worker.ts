/** Reads videos and makes motions of what was seen, off the main thread. */
import { serve, type TaskContext } from '../common/run-in-worker';
import { yieldToEvents } from '../common/yield-to-events';
import { writeBvh } from '../motion/bvh/write';
import { checkSeen } from './checks';
import { openVideo } from './frames';
import { type Observations, Recorder } from './observations';
import { loadPoseGraphs } from './pose/graphs';
import type { Person } from './pose/detector';
import { PersonTracker, type Point } from './pose/tracker';
import { adviceOn, confidenceOf } from './world/advice';
import { type WorldOptions, reconstruct } from './world/reconstruct';

export interface ReadRequest {
  readonly file: Blob;
  /** Absolute address of pose.json. */
  readonly graphs: string;
  /** Where the person stands who is followed, pixels of the first picture with people; null takes the largest. */
  readonly pick: Point | null;
}

/** What happens while a video is being read. */
export type ReadReport =
  /** Share of the networks that is downloaded, 0 to 1. */
  | { readonly kind: 'networks'; readonly fraction: number }
  | {
      readonly kind: 'opened';
      readonly duration: number;
      readonly width: number;
      readonly height: number;
      readonly hasSound: boolean;
    }
  /** Several people, of whom one can be picked. */
  | { readonly kind: 'persons'; readonly time: number; readonly boxes: readonly Person['box'][] }
  /** The newest picture: its time, and 33 x 2 landmarks in pixels where the person is seen. */
  | { readonly kind: 'picture'; readonly time: number; readonly landmarks: Float32Array | null };

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
  /** How sure each frame is, 0 to 1. */
  readonly confidence: Float32Array;
  /** What to film better. */
  readonly advice: readonly string[];
}

/** Least time between two reports of pictures. */
const REPORT_INTERVAL_MS = 200;

async function read(
  { file, graphs: list, pick }: ReadRequest,
  { signal, report }: TaskContext<ReadReport>,
): Promise<Observations> {
  const video = await openVideo(file);
  try {
    const { duration, width, height, hasSound } = video;
    void report({ kind: 'opened', duration, width, height, hasSound });
    const graphs = await loadPoseGraphs(list, globalThis, (fraction) => {
      void report({ kind: 'networks', fraction });
    });
    const tracker = new PersonTracker(graphs, pick);
    const recorder = new Recorder(width, height);
    let reported = 0;
    let asked = false;
    for await (const { time, picture } of video.pictures(0, Infinity)) {
      const tracked = await tracker.next(picture);
      recorder.add(time, tracked);
      if (!asked && tracked.persons && tracked.persons.length > 0) {
        asked = true;
        if (tracked.persons.length > 1)
          void report({ kind: 'persons', time, boxes: tracked.persons.map(({ box }) => box) });
      }
      if (performance.now() - reported > REPORT_INTERVAL_MS) {
        reported = performance.now();
        const landmarks = tracked.landmarks?.image.slice() ?? null;
        void report({ kind: 'picture', time, landmarks });
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

function solve({ observations, options }: SolveRequest): VideoMotion {
  const result = reconstruct(observations, options);
  return {
    bvh: writeBvh(result.motion),
    start: result.series.start,
    confidence: confidenceOf(result.series),
    advice: adviceOn(result.series, result.flipped),
  };
}

const tasks = { read, solve };
export type VideoTasks = typeof tasks;

serve(tasks);
