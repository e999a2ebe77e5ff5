import { movesNode, timingOf, tracksOf } from './animation';
import { type Gltf, readContainer } from './container';
import { humanoidNames } from './humanoid';
import { posesOf, skeletonOf } from './skeleton';
import { onBody } from './on-body';
import { refuseTooLong } from '../../retarget/length';
import type { FileBytes } from '../read';
import { AppError } from '../../../common/error';
import { pickDancer, pickFirstDancer } from '../../retarget/dancers';
import type { MotionSource } from '../../retarget/source';

/** The name of the format by the extensions that a file has. */
function formatOf({ extensions }: Gltf): string {
  if ('VRMC_vrm_animation' in extensions) return 'VRMA';
  return 'VRMC_vrm' in extensions || 'VRM' in extensions ? 'VRM' : 'glTF';
}

/**
 * Reads a GLB, glTF, VRM or VRMA file: the hierarchy of its nodes and one of its clips. Meshes and pictures are left out.
 * A VRM beside a VRMA lends it its body.
 *
 * @param part number of the clip; of the dancer in a file with one clip and several dancers
 * @throws {AppError} `unreadable-file`, `missing-file`, `no-motion`, `too-few-frames` or `too-long`
 */
export function readGltf(files: readonly [FileBytes, ...FileBytes[]], part: number): MotionSource {
  const [main, ...companions] = files;
  const file = readContainer(main, companions);
  const { json } = file;
  const format = formatOf(json);
  const skeleton = skeletonOf(json, humanoidNames(json));
  // A pose of one key, what moves no node, and a damaged clip beside others are left out.
  let failure: unknown = null;
  const clips = json.animations
    .flatMap((animation, number) => {
      try {
        const tracks = tracksOf(file, animation);
        return [{ name: (animation.name ?? `clip ${number + 1}`).slice(0, 80), tracks, ...timingOf(tracks) }];
      } catch (error) {
        failure ??= error;
        return [];
      }
    })
    .filter(({ frames }) => frames >= 2);
  const clip = clips[part] ?? clips[0];
  if (!clip && failure) throw failure as Error;
  if (!clip)
    throw json.animations.some(({ channels }) => channels.length > 0) ? noLength() : noMotion(format);
  const { tracks, start, frames, fps } = clip;
  refuseTooLong(frames, skeleton.joints.length * 6);
  const source: MotionSource = {
    format,
    joints: skeleton.joints,
    rest: posesOf(skeleton, tracks, [null]),
    frames,
    frameRate: () => fps,
    rateAssumed: false,
    unit: { name: 'metres', metres: 1 },
    upAxis: 'y',
    parts: clips.length > 1 ? clips.map(({ name }) => name) : [],
    part: clips.indexOf(clip),
    warnings: [],
    truncated: false,
    localPoses: (wanted) =>
      posesOf(
        skeleton,
        tracks,
        wanted.map((frame) => start + frame / fps),
      ),
  };
  const body = format === 'VRMA' ? companions.find(({ name }) => /\.vrm$/i.test(name)) : undefined;
  if (body) {
    const bones = [...humanoidNames(json)].map(
      ([node, name]) => [name, skeleton.nodes.indexOf(node)] as const,
    );
    return onBody(source, readContainer(body, []).json, new Map(bones));
  }
  const moves = (joint: number): boolean => movesNode(tracks, skeleton.nodes[joint]!);
  return clips.length > 1 ? pickFirstDancer(source, moves) : pickDancer(source, part, moves);
}

function noLength(): AppError {
  return new AppError(
    'too-few-frames',
    'The animation in the file has no length.',
    'Export the whole animation, not only its current frame.',
  );
}

function noMotion(format: string): AppError {
  return format === 'VRM'
    ? new AppError(
        'no-motion',
        'The VRM file holds a body without a motion.',
        'Choose it together with the VRMA file that moves it.',
      )
    : new AppError(
        'no-motion',
        'The file holds no animation.',
        'Export it again with its animation: in Blender, mark “Animation” among the export settings.',
      );
}
