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
  /** Start of the song after the first frame, frames; negative where it began before. */
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
  const { frames } = firstMotion(dance);
  if (frames <= count) return dance;
  return withFrames(
    dance,
    Array.from({ length: count }, (_, i) => Math.floor((i * frames) / count)),
  );
}

/** The frames of a dance from `from` to before `to`; the dance as it is when those are all. */
export function partOf(dance: Dance, from: number, to: number): Dance {
  if (from === 0 && to === firstMotion(dance).frames) return dance;
  const part = withFrames(
    dance,
    Array.from({ length: to - from }, (_, i) => from + i),
  );
  const { song, shift } = dance.about;
  return { ...part, about: { ...dance.about, shift: song === null ? shift : shift - from } };
}

function withFrames(dance: Dance, picked: readonly number[]): Dance {
  const pick = (values: Float32Array, frames: number): Float32Array => {
    const width = values.length / frames;
    const out = new Float32Array(picked.length * width);
    picked.forEach((frame, i) => out.set(values.subarray(frame * width, (frame + 1) * width), i * width));
    return out;
  };
  return {
    ...dance,
    dancers: dance.dancers.map(({ role, motion }) => {
      const { frames } = motion;
      const [root, rotations, positions] = [
        pick(motion.root, frames),
        pick(motion.rotations, frames),
        pick(motion.positions, frames),
      ];
      return { role, motion: { ...motion, frames: picked.length, root, rotations, positions } };
    }),
  };
}
