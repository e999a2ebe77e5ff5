import type { Song } from '../../audio/client';
import type { Generator, Manifest } from '../../model/client';
import type { ReadLeader } from '../../motion/client';
import { solve } from '../../motion/fit/ik';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { headingOf } from '../../motion/skeleton/heading';
import { JOINT_COUNT, MIRROR } from '../../motion/skeleton/skeleton';
import { OURS, type StudyDuet, type StudySet } from './set';

/** The leaders that ship with the page, by their files. */
const LEADERS = [
  ['demo', 'demo/leader.bvh'],
  ['slow', 'leaders/slow.bvh'],
  ['quick', 'leaders/quick.bvh'],
  ['turning', 'leaders/turning.bvh'],
  ['playful', 'leaders/playful.bvh'],
] as const;

/** The ends of coarse guidance, by the name of the method. */
const ENDS = { 'coarse-low': 'min', 'coarse-high': 'max' } as const;
const METHODS = [OURS, ...Object.keys(ENDS), 'mirror'];

/** Of the first leader's partners; those of the others follow. */
const FIRST_SEED = 1206;
/** How far ahead of the leader's first place the mirror stands, metres. */
const MIRROR_DISTANCE = 0.45;

/** What the set is made of, as arguments so that it can be tested without a browser. */
export interface BuiltInParts {
  /** A file of the page. */
  readonly file: (path: string) => Promise<Blob>;
  readonly readLeader: (name: string, bytes: Uint8Array) => Promise<ReadLeader>;
  readonly loadSong: (file: Blob, audio: Manifest['audio']) => Promise<Song>;
  readonly generator: () => Promise<Pick<Generator, 'generate' | 'manifest'>>;
}

/** Calls once, and again only after a failure. */
function once<T>(make: () => Promise<T>): () => Promise<T> {
  let made: Promise<T> | null = null;
  return () => {
    made ??= make().catch((error: unknown) => {
      made = null;
      throw error;
    });
    return made;
  };
}

/**
 * A study that needs no files: the leaders of the page with partners by the model at its defaults, at both ends of coarse
 * guidance, and a mirror image.
 */
export async function builtInSet(parts: BuiltInParts): Promise<StudySet> {
  const song = await parts.file('demo/song.mp3');
  const analysed = once(async () => parts.loadSong(song, (await parts.generator()).manifest.audio));
  const duets = LEADERS.map(([name, path], index): StudyDuet => {
    const leader = once(async () => {
      const bytes = new Uint8Array(await (await parts.file(path)).arrayBuffer());
      return parts.readLeader(path, bytes);
    });
    const generated = async (coarse: 'min' | 'default' | 'max'): Promise<SolvedMotion> => {
      const [{ file, motion }, generator, music] = await Promise.all([
        leader(),
        parts.generator(),
        analysed(),
      ]);
      const { guidance, latent } = generator.manifest;
      const layers = latent.streams.flatMap(() =>
        latent.layers.map((layer) => (layer === 'coarse' ? guidance.coarse[coarse] : guidance.fine.default)),
      );
      const { locked } = await generator.generate({
        leader: file.clip,
        fitted: motion,
        music: { features: music.features, frames: music.frames, beats: music.rhythm.beats },
        guidance: Float32Array.from(layers),
        musicGuidance: guidance.music.default,
        variety: guidance.variety.default,
        seed: FIRST_SEED + index,
      });
      return locked;
    };
    const made: Readonly<Record<string, () => Promise<SolvedMotion>>> = {
      [OURS]: once(() => generated('default')),
      ...Object.fromEntries(
        Object.entries(ENDS).map(([method, end]) => [method, once(() => generated(end))]),
      ),
      mirror: once(async () => mirrored((await leader()).file.clip)),
    };
    return {
      name,
      methods: METHODS,
      song,
      leader: async () => (await leader()).motion,
      partner: (method) => made[method]!(),
    };
  });
  return { name: 'built-in', reference: OURS, duets };
}

/** A partner who dances as the leader's image in a mirror that stands still before the leader: a simple baseline. */
export function mirrored({ positions, frames, fps }: MotionClip): SolvedMotion {
  const heading = headingOf(positions.subarray(0, JOINT_COUNT * 3));
  const [nx, nz] = [Math.sin(heading), Math.cos(heading)];
  const offset = positions[0]! * nx + positions[2]! * nz + MIRROR_DISTANCE;
  const image = new Float32Array(positions.length);
  for (let frame = 0; frame < frames; frame++) {
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const from = 3 * (frame * JOINT_COUNT + MIRROR[joint]!);
      const [x, y, z] = [positions[from]!, positions[from + 1]!, positions[from + 2]!];
      const through = 2 * (x * nx + z * nz - offset);
      image.set([x - through * nx, y, z - through * nz], 3 * (frame * JOINT_COUNT + joint));
    }
  }
  return solve({ fps, frames, positions: image });
}
