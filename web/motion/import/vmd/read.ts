import { MMD_JOINTS, MMD_OFFSETS, mmdBone } from './body';
import { poseAt } from './curve';
import { readVmdFile, type Vmd } from './file';
import { solveLeg } from './leg-ik';
import { refuseTooFew } from '../../retarget/length';
import { AppError } from '../../../common/error';
import { multiply, type Quat, rotate, writeQuat } from '../../math/quat';
import { add, type Vec3, writeVec } from '../../math/vec3';
import { type LocalPoses, type MotionSource, restOf } from '../../retarget/source';

/** Frames per second of every VMD. */
const FPS = 30;
const SIDES = ['左', '右'] as const;

/** Longest time without a key, frames: a minute. */
const MAX_STILL = 1800;

/** The longest way between two frames that have keys. */
function longestStill(frames: readonly number[]): number {
  const sorted = [0, ...frames].sort((a, b) => a - b);
  return sorted.slice(1).reduce((most, frame, i) => Math.max(most, frame - sorted[i]!), 0);
}

/** Whether a leg follows its IK bone in a frame: as switched, else where that bone has keys. */
function followsIk({ bones, switches }: Vmd, side: string, frame: number): boolean {
  const name = `${side}足ＩＫ`;
  const last = switches.findLast((one) => one.bone === name && one.frame <= frame);
  return (last?.on ?? true) && (bones.has(name) || bones.has(`${side}足IK親`));
}

/** Transforms of all bones from their parents in a frame, and with the feet placed. */
function poseOf(vmd: Vmd, frame: number): { turns: Quat[]; places: Vec3[] } {
  const poses = MMD_JOINTS.map(({ name }) => poseAt(vmd.bones.get(name), frame));
  const turns = poses.map(({ turn }) => turn);
  const places = poses.map(({ move }, bone) => add(MMD_OFFSETS[bone]!, move));
  const world: { turn: Quat; place: Vec3 }[] = [];
  MMD_JOINTS.forEach(({ parent }, bone) => {
    const above = world[parent];
    world.push(
      above
        ? {
            turn: multiply(above.turn, turns[bone]!),
            place: add(above.place, rotate(above.turn, places[bone]!)),
          }
        : { turn: turns[bone]!, place: places[bone]! },
    );
  });
  for (const side of SIDES) {
    if (!followsIk(vmd, side, frame)) continue;
    const at = (name: string): number => mmdBone(`${side}${name}`);
    const [hip, knee, ankle] = [at('足'), at('ひざ'), at('足首')];
    const solved = solveLeg({
      hip: world[hip]!.place,
      above: world[mmdBone('下半身')]!.turn,
      hipTurn: turns[hip]!,
      ankleTurn: turns[ankle]!,
      thigh: places[knee]!,
      shin: places[ankle]!,
      foot: places[at('つま先')]!,
      ankleAt: world[at('足ＩＫ')]!.place,
      toeAt: world[at('つま先ＩＫ')]!.place,
    });
    [turns[hip], turns[knee], turns[ankle]] = solved;
  }
  return { turns, places };
}

/**
 * Reads a VMD file on a usual MMD body (body.ts), feet placed by inverse kinematics.
 *
 * @throws {AppError} `unreadable-file`, `no-motion`, `too-long` or `too-few-frames`
 */
export function readVmd(bytes: Uint8Array): MotionSource {
  const vmd = readVmdFile(bytes);
  const keys = MMD_JOINTS.flatMap(({ name }) => vmd.bones.get(name) ?? []);
  if (keys.length === 0) {
    throw new AppError(
      'no-motion',
      'The VMD file moves none of the bones of a body.',
      'Choose the VMD file of the dancer’s body, not of a camera or a face.',
    );
  }
  const frames = keys.reduce((last, { frame }) => Math.max(last, frame), 0) + 1;
  if (longestStill(keys.map(({ frame }) => frame)) > MAX_STILL) {
    throw new AppError(
      'unreadable-file',
      'In the VMD file nothing moves for more than a minute.',
      'Cut the motion to the dance, or download it again: a key may be at a wrong frame.',
    );
  }
  refuseTooFew(frames);
  const count = MMD_JOINTS.length;
  return {
    format: 'VMD',
    joints: MMD_JOINTS,
    rest: restOf(Float32Array.from(MMD_OFFSETS.flat())),
    frames,
    frameRate: () => FPS,
    rateAssumed: false,
    unit: { name: 'MMD units of 8 cm', metres: 0.08 },
    upAxis: 'y',
    parts: [],
    part: 0,
    warnings: ['A VMD file holds a motion without a body, so a usual MMD body of 1.60 m is used.'],
    truncated: false,
    localPoses: (wanted): LocalPoses => {
      const rotations = new Float32Array(wanted.length * count * 4);
      const translations = new Float32Array(wanted.length * count * 3);
      wanted.forEach((frame, place) => {
        const { turns, places } = poseOf(vmd, frame);
        turns.forEach((turn, bone) => writeQuat(rotations, place * count + bone, turn));
        places.forEach((step, bone) => writeVec(translations, place * count + bone, step));
      });
      return { rotations, translations };
    },
  };
}
