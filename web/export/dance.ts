import type { Role } from '../common/role';
import type { SolvedMotion } from '../motion/skeleton/clip';
import { PARENTS, SMPL22 } from '../motion/skeleton/skeleton';

/** Where a motion comes from and what it was made with: written into every format that has room for it. */
export interface About {
  readonly song: string | null;
  readonly leader: string;
  readonly take: string | null;
  readonly model: { readonly id: string; readonly name: string } | null;
  /** Guidance, seed and role, as the page has them. */
  readonly settings: object;
  /** Start of the song after the start of the dance, frames. */
  readonly shift: number;
  /** Whether feet in contact with the floor were kept from sliding, for the dancer that the model made. */
  readonly footLock: boolean;
}

/** What is exported: one dancer, or leader and reactor, with the same number of frames and frame rate. */
export interface Dance {
  readonly dancers: readonly { readonly role: Role; readonly motion: SolvedMotion }[];
  readonly about: About;
}

export type MotionFormat = 'bvh' | 'glb' | 'npz' | 'json';

/** The first dancer's motion, for what all dancers share: number of frames and frame rate. */
export function firstMotion(dance: Dance): SolvedMotion {
  const [first] = dance.dancers;
  if (!first) throw new RangeError('A dance without dancers cannot be written.');
  return first.motion;
}

/** What every format with room for it says about a dance beside its numbers: format, units, axes, joints, origin. */
export function metadataOf(dance: Dance): object {
  const { fps, frames } = firstMotion(dance);
  return {
    format: 'reactdance-motion',
    version: 1,
    units: { position: 'metres', time: 'seconds' },
    axes: 'y up, right-handed; the floor is at height 0',
    fps,
    frames,
    dancers: dance.dancers.map(({ role }) => role),
    joints: SMPL22,
    parents: PARENTS,
    ...dance.about,
  };
}

/** The same dance with `count` evenly spaced frames of it, or as it is when it has no more. */
export function subsampled(dance: Dance, count: number): Dance {
  return {
    ...dance,
    dancers: dance.dancers.map(({ role, motion }) => {
      const { frames } = motion;
      if (frames <= count) return { role, motion };
      const picked = Array.from({ length: count }, (_, i) => Math.floor((i * frames) / count));
      const pick = (values: Float32Array): Float32Array => {
        const width = values.length / frames;
        const out = new Float32Array(count * width);
        picked.forEach((frame, i) => out.set(values.subarray(frame * width, (frame + 1) * width), i * width));
        return out;
      };
      const [root, rotations, positions] = [
        pick(motion.root),
        pick(motion.rotations),
        pick(motion.positions),
      ];
      return { role, motion: { ...motion, frames: count, root, rotations, positions } };
    }),
  };
}
