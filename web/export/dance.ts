import type { SolvedMotion } from '../motion/skeleton/clip';
import type { Role } from '../view/theme';

/** Where a motion comes from and what it was made with: written into every format that has room for it. */
export interface About {
  readonly song: string | null;
  readonly leader: string;
  readonly take: string | null;
  readonly model: { readonly id: string; readonly name: string } | null;
  /** Guidance, steps, seed and role, as the page has them. */
  readonly settings: object;
  /** Frames that the song begins after the dance. */
  readonly shift: number;
  /** Whether planted feet of the dancer who was made were kept from sliding. */
  readonly footLock: boolean;
}

/** What is taken home: one dancer, or the leader and the reactor, of the same frames and rate. */
export interface Dance {
  readonly dancers: readonly { readonly role: Role; readonly motion: SolvedMotion }[];
  readonly about: About;
}

export type MotionFormat = 'bvh' | 'glb' | 'npz' | 'json';

/** The first dancer's motion, for what all dancers share: frames and rate. */
export function firstMotion(dance: Dance): SolvedMotion {
  const [first] = dance.dancers;
  if (!first) throw new RangeError('A dance without dancers cannot be written.');
  return first.motion;
}

/** The same dance in `count` frames picked evenly from all of it, or as it is when it has no more. */
export function sampled(dance: Dance, count: number): Dance {
  return {
    ...dance,
    dancers: dance.dancers.map(({ role, motion }) => {
      const { frames } = motion;
      if (frames <= count) return { role, motion };
      const kept = Array.from({ length: count }, (_, i) => Math.floor((i * frames) / count));
      const pick = (values: Float32Array): Float32Array => {
        const width = values.length / frames;
        const out = new Float32Array(count * width);
        kept.forEach((frame, i) => out.set(values.subarray(frame * width, (frame + 1) * width), i * width));
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
