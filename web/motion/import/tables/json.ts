import { sourceOfPoints } from '../keypoints';
import { refuseTooLong } from '../../retarget/length';
import { leaderFirst, SMPL_JOINTS } from '../positions';
import { AppError } from '../../../common/error';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource, SourceJoint } from '../../retarget/source';

/** Largest number of joints of one dancer. */
const MAX_JOINTS = 1000;
/** What names points in a picture, and how far from its beginning a file is searched for it. */
const IN_PICTURE = /"(pose_keypoints_2d|keypoints)"/;
const IN_PICTURE_START = 4096;
const METRES = { name: 'metres', metres: 1 } as const;

function invalid(what: string): AppError {
  return new AppError(
    'not-motion',
    `This JSON file does not hold a motion: ${what}.`,
    'Use a file that this page wrote as JSON, or the same form: "fps", "joints" and "positions" by dancer.',
  );
}

const isList = (value: unknown): value is unknown[] => Array.isArray(value);

/** The joints that the file names, or the 22. */
function jointsOf(names: unknown, parents: unknown): readonly SourceJoint[] {
  if (!isList(names)) return SMPL_JOINTS;
  if (names.length === 0 || names.length > MAX_JOINTS) throw invalid(`it names ${names.length} joints`);
  return names.map((name, joint) => {
    const parent: unknown = isList(parents) ? parents[joint] : -1;
    const before = typeof parent === 'number' && Number.isInteger(parent) && parent >= 0 && parent < joint;
    return { name: String(name).slice(0, 80), parent: before ? parent : -1 };
  });
}

/** The positions of one dancer: a list of frames of points. */
function placesOf(frames: readonly unknown[], joints: number): Float32Array {
  refuseTooLong(frames.length, joints * 3);
  const places = new Float32Array(frames.length * joints * 3);
  frames.forEach((frame, i) => {
    if (!isList(frame) || frame.length !== joints)
      throw invalid(`frame ${i + 1} does not have ${joints} points`);
    frame.forEach((point: unknown, joint) => {
      for (let axis = 0; axis < 3; axis++) {
        const value: unknown = isList(point) && point.length === 3 ? point[axis] : undefined;
        if (typeof value !== 'number') throw invalid(`point ${joint + 1} of frame ${i + 1} is not [x, y, z]`);
        places[(i * joints + joint) * 3 + axis] = value;
      }
    });
  });
  return places;
}

/**
 * Reads the JSON that this page writes: metadata, and positions by dancer.
 *
 * @param part number of the dancer
 * @throws {AppError} `not-motion`, `too-long`, `too-few-frames` or `bad-frame-time`
 */
export function readJsonMotion(text: string, part: number): MotionSource {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw invalid('it is not whole');
  }
  if (json === null || typeof json !== 'object') throw invalid('it holds no object');
  if (IN_PICTURE.test(text.slice(0, IN_PICTURE_START))) {
    throw new AppError(
      'not-motion',
      'This JSON file holds points in a picture, without depth, as OpenPose and AlphaPose write them.',
      'Drop the video itself: a dancer in a video is read here.',
    );
  }
  const { fps, joints: names, parents, positions } = json as Record<string, unknown>;
  if (positions === null || typeof positions !== 'object') throw invalid('it has no "positions"');
  const dancers = isList(positions) ? [['dancer', positions] as const] : Object.entries(positions);
  const lists = leaderFirst(
    dancers.filter((entry): entry is [string, unknown[]] => isList(entry[1])),
    ([name]) => name,
  );
  const at = part < lists.length ? part : 0;
  const frames = lists[at]?.[1];
  if (!frames) throw invalid('its "positions" hold no dancer');
  const joints = jointsOf(names, parents);
  const rate = typeof fps === 'number' ? fps : null;
  return sourceOfPoints(
    { joints, places: placesOf(frames, joints.length) },
    {
      format: 'JSON',
      frameRate: () => checkedRate(rate ?? ASSUMED_FPS),
      rateAssumed: rate === null,
      unit: METRES,
      upAxis: 'y',
      parts: lists.length > 1 ? lists.map(([name]) => name.slice(0, 80)) : [],
      part: at,
    },
  );
}
