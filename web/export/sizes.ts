import type { Role } from '../common/role';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { standingHeight } from '../motion/skeleton/kinematics';
import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import { writeBvh } from '../motion/bvh/write';
import { type Dance, firstMotion, type MotionFormat, subsampled } from './dance';
import { writeJson } from './json';
import { writeNpz } from './npz';

/** Number of frames that are written to measure the length of a frame as text. */
const SAMPLE_FRAMES = 40;
/** Compressed size of BVH text as a share of its size, measured on generated dances. */
const ZIP_RATIO = 0.37;
/** Bytes of a mannequin in a GLB for each metre of its height: its triangles are as large whatever its size. */
const BODY_BYTES_A_METRE = { leader: 350_000, reactor: 323_000 };

/** Estimated size of a file before it is written, bytes. */
export function estimateBytes(format: MotionFormat, dance: Dance): number {
  const { frames } = firstMotion(dance);
  switch (format) {
    case 'npz':
      return writeNpz(dance).length;
    case 'json':
      return extrapolated((part) => writeJson(part).length, dance);
    case 'bvh': {
      const text = dance.dancers.map((dancer) =>
        extrapolated((part) => writeBvh(firstMotion(part)).length, { ...dance, dancers: [dancer] }),
      );
      const sum = text.reduce((total, bytes) => total + bytes, 0);
      return dance.dancers.length > 1 ? sum * ZIP_RATIO : sum;
    }
    case 'glb':
      // A rotation of each joint that turns and a position of the root, each with its time.
      return dance.dancers
        .map(({ role, motion }) => bodyBytes(role, motion) + frames * 4 * (5 * turningJoints(motion) + 4))
        .reduce((total, bytes) => total + bytes, 0);
  }
}

function bodyBytes(role: Role, { offsets }: SolvedMotion): number {
  return standingHeight(offsets) * BODY_BYTES_A_METRE[role];
}

/** How many joints turn at all: a generated dancer has no turns of its own in head, wrists and balls of the feet. */
function turningJoints({ rotations }: SolvedMotion): number {
  const frameSize = JOINT_COUNT * 4;
  const turning = new Set<number>();
  rotations.forEach((value, at) => {
    if (value !== rotations[at % frameSize]) turning.add(Math.floor((at % frameSize) / 4));
  });
  return turning.size;
}

/** Size of a text that grows linearly with the number of frames, extrapolated from two short ones. */
function extrapolated(size: (dance: Dance) => number, dance: Dance): number {
  const { frames } = firstMotion(dance);
  if (frames <= SAMPLE_FRAMES) return size(dance);
  const short = size(subsampled(dance, 1));
  const perFrame = (size(subsampled(dance, SAMPLE_FRAMES)) - short) / (SAMPLE_FRAMES - 1);
  return short + perFrame * (frames - 1);
}
