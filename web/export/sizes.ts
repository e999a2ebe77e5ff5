import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import { writeBvh } from '../motion/bvh/write';
import { type Dance, firstMotion, type MotionFormat, sampled } from './dance';
import { writeJson } from './json';
import { writeNpz } from './npz';

/** Frames that are written out to learn how long a frame is as text. */
const SAMPLE = 40;
/** What is left of BVH text in an archive, measured on generated dances. */
const ZIPPED = 0.37;
/** Bytes of a mannequin in a GLB: about 7,300 vertices and 14,500 triangles. */
const BODY = 590_000;
/** Joints that never turn by themselves, so that their tracks shrink to nothing: head, wrists, balls of the feet. */
const RESTING = 5;

/** About how many bytes a file will have, known before it is written. */
export function estimateBytes(format: MotionFormat, dance: Dance): number {
  const { frames } = firstMotion(dance);
  switch (format) {
    case 'npz':
      return writeNpz(dance).length;
    case 'json':
      return grown((part) => writeJson(part).length, dance);
    case 'bvh': {
      const text = dance.dancers.map((dancer) =>
        grown((part) => writeBvh(firstMotion(part)).length, { ...dance, dancers: [dancer] }),
      );
      const sum = text.reduce((total, bytes) => total + bytes, 0);
      return dance.dancers.length > 1 ? sum * ZIPPED : sum;
    }
    case 'glb':
      // A turn for each joint and a place for the root, each with its time.
      return dance.dancers.length * (BODY + frames * 4 * (5 * (JOINT_COUNT - RESTING) + 4));
  }
}

/** Size of a text that grows by the same with every frame, from two short ones. */
function grown(size: (dance: Dance) => number, dance: Dance): number {
  const { frames } = firstMotion(dance);
  if (frames <= SAMPLE) return size(dance);
  const short = size(sampled(dance, 1));
  const perFrame = (size(sampled(dance, SAMPLE)) - short) / (SAMPLE - 1);
  return short + perFrame * (frames - 1);
}
