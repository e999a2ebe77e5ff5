import type { SolvedMotion } from '../../../motion/skeleton/clip';
import type { LoadedLeader, LoadedSong, Reaction, Take } from '../reaction';

/** Parts of the state that refer to songs, leaders and motions. */
interface Holder {
  readonly song?: LoadedSong | null;
  readonly leader?: LoadedLeader | null;
  readonly reaction?: Reaction | null;
  readonly takes?: readonly Take[];
}

/**
 * How many of the holders, from the first on, hold no more than `most` bytes together that `present` does not hold
 * anyway; at least one. A value that several hold counts once.
 */
export function countWithin(most: number, present: Holder, holders: readonly Holder[]): number {
  const seen = new Set<object>();
  addedBytes(present, seen);
  let sum = 0;
  for (const [index, holder] of holders.entries()) {
    sum += addedBytes(holder, seen);
    if (sum > most) return Math.max(1, index);
  }
  return holders.length;
}

/** Bytes of the holder's values that have not been seen; they have been afterwards. */
function addedBytes({ song, leader, reaction, takes = [] }: Holder, seen: Set<object>): number {
  let sum = 0;
  const add = <T extends object>(value: T | null | undefined, bytes: (value: T) => number): void => {
    if (!value || seen.has(value)) return;
    seen.add(value);
    sum += bytes(value);
  };
  add(song, songBytes);
  add(leader, leaderBytes);
  for (const made of [reaction, ...takes.map((take) => take.reaction)]) {
    if (!made) continue;
    add(made.inputs.song, songBytes);
    add(made.inputs.leader, leaderBytes);
    add(made.motion, motionBytes);
    add(made.latents, ({ byteLength }) => byteLength);
  }
  return sum;
}

function songBytes({ file, data }: LoadedSong): number {
  return file.size + data.sound.size + data.features.byteLength + 2 * data.waveform.high.byteLength;
}

function leaderBytes({ files, file, motion }: LoadedLeader): number {
  const read = files.reduce((sum, { bytes }) => sum + bytes.byteLength, 0);
  return read + file.clip.positions.byteLength + motionBytes(motion);
}

function motionBytes({ root, rotations, positions }: SolvedMotion): number {
  return root.byteLength + rotations.byteLength + positions.byteLength;
}
