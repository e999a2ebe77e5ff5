import { type Bone, damagedAsf, inOrder, readAsf } from './asf';
import { refuseTooFew, refuseTooLong } from '../../retarget/length';
import type { FileBytes } from '../read';
import { AppError } from '../../../common/error';
import { conjugate, multiply, type Quat, writeQuat } from '../../math/quat';
import { type Vec3, writeVec } from '../../math/vec3';
import { checkedRate } from '../../retarget/frame-rate';
import type { LocalPoses, MotionSource, SourceJoint } from '../../retarget/source';
import { linesOf } from '../../../common/lines';

/** Frames per second of the CMU library, which an AMC does not state. */
const USUAL_RATE = 120;
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The values of every bone by frame. */
type Frames = ReadonlyMap<string, readonly number[]>[];

/** The frames of an AMC: a number alone on its line, then a line for every bone that moves. */
function framesOf(text: string, bones: readonly Bone[]): Frames {
  const channels = new Map(bones.map((bone) => [bone.name, bone.channels.length]));
  const frames: Map<string, readonly number[]>[] = [];
  const lines = linesOf(text.trimEnd());
  lines.forEach((line, number) => {
    const words = line.trim().split(/\s+/);
    const [name = ''] = words;
    if (name === '' || name.startsWith('#') || name.startsWith(':')) return;
    if (words.length === 1 && /^\d+$/.test(name)) {
      frames.push(new Map());
      refuseTooLong(frames.length, bones.length * 7);
      return;
    }
    const count = channels.get(name);
    const frame = frames.at(-1);
    const values = words.slice(1);
    const isSound = values.every((word) => NUMBER.test(word) && Math.abs(Number(word)) < 1e7);
    const isWhole = count !== undefined && values.length >= count && isSound;
    // A file that is cut off ends within a line: its last frame then lacks a bone.
    if (!isWhole && number === lines.length - 1 && frames.length > 2) return;
    if (!frame || count === undefined) {
      // Bones of another skeleton are named once, not for every frame.
      if (frames.length > 0) throw otherSkeleton(name);
      return;
    }
    if (!isWhole)
      throw damagedAsf(`line ${number + 1} does not have ${count} numbers for ${name.slice(0, 40)}`);
    frame.set(name, values.map(Number));
  });
  return frames;
}

function otherSkeleton(name: string): AppError {
  return new AppError(
    'missing-joints',
    `The motion moves a bone "${name.slice(0, 40)}" that the skeleton does not have.`,
    'Choose the ASF of the same person: 60.asf for 60_10.amc.',
  );
}

/** The value of a channel of a bone in a frame; 0 where the bone does not move. */
function channelsOf(bone: Bone, values: readonly number[] | undefined): (name: string) => number {
  return (name) => {
    const at = bone.channels.indexOf(name);
    return at < 0 ? 0 : (values?.[at] ?? 0);
  };
}

/** Rotation of a bone from its parent; both have the axes of the world in the rest pose. */
function rotationOf(bone: Bone, value: (channel: string) => number, radians: number): Quat {
  const turning = bone.channels.filter((channel) => channel.startsWith('r'));
  const order = turning.map((channel) => channel.at(1)!).join('');
  const own = inOrder(
    order,
    turning.map((channel) => value(channel) * radians),
  );
  return multiply(multiply(bone.axes, own), conjugate(bone.axes));
}

/**
 * Reads an AMC motion with its ASF skeleton.
 *
 * @param files both, in any order
 * @throws {AppError} `missing-file`, `unreadable-file`, `missing-joints`, `too-few-frames` or `too-long`
 */
export function readAmc(files: readonly FileBytes[]): MotionSource {
  const texts = files.map(({ bytes }) => new TextDecoder().decode(bytes));
  const isSkeleton = (text: string): boolean => /^:bonedata\b/im.test(text);
  const skeleton = texts.find(isSkeleton);
  const motion = texts.find((text) => !isSkeleton(text) && /^\s*\d+\s*$/m.test(text));
  if (skeleton === undefined || motion === undefined) {
    const [have, lack] = skeleton === undefined ? ['AMC', 'ASF'] : ['ASF', 'AMC'];
    throw new AppError(
      'missing-file',
      `The ${lack} file is missing: ${have === 'AMC' ? 'an AMC holds angles without a skeleton' : 'an ASF holds a skeleton without a motion'}.`,
      'Choose or drop the AMC and its ASF together, as 60_10.amc with 60.asf.',
    );
  }
  const { bones, metres, radians } = readAsf(skeleton);
  const frames = framesOf(motion, bones);
  const all = frames.length;
  const truncated = all > 2 && frames.at(-1)!.size < frames[0]!.size;
  if (truncated) frames.pop();
  refuseTooFew(frames.length);
  const tips = bones.flatMap((_, at) => (bones.some(({ parent }) => parent === at) ? [] : [at]));
  const joints: SourceJoint[] = [
    ...bones.map(({ name, parent }) => ({ name, parent })),
    ...tips.map((at) => ({ name: `end of ${bones[at]!.name}`, parent: at, endSite: true })),
  ];
  const poses = (rows: readonly (ReadonlyMap<string, readonly number[]> | null)[]): LocalPoses => {
    const rotations = new Float32Array(rows.length * joints.length * 4);
    const translations = new Float32Array(rows.length * joints.length * 3);
    rows.forEach((row, frame) => {
      joints.forEach(({ parent }, joint) => {
        const bone = bones[joint];
        const value = bone ? channelsOf(bone, row?.get(bone.name)) : () => 0;
        const place: Vec3 = parent < 0 ? [value('tx'), value('ty'), value('tz')] : bones[parent]!.vector;
        writeQuat(
          rotations,
          frame * joints.length + joint,
          bone ? rotationOf(bone, value, radians) : [0, 0, 0, 1],
        );
        writeVec(translations, frame * joints.length + joint, place);
      });
    });
    return { rotations, translations };
  };
  return {
    format: 'AMC with ASF',
    joints,
    rest: poses([null]),
    frames: frames.length,
    frameRate: () => checkedRate(USUAL_RATE),
    rateAssumed: true,
    unit: { name: metres > 0.05 ? 'CMU units of 5.64 cm' : 'units of the ASF', metres },
    upAxis: 'y',
    parts: [],
    part: 0,
    warnings: truncated
      ? [`The file ends in the middle of frame ${all}; the ${all - 1} whole frames are used.`]
      : [],
    truncated,
    localPoses: (wanted) => poses(wanted.map((frame) => frames[frame]!)),
  };
}
