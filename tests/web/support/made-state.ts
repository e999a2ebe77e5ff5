import type { Song } from '../../../web/audio/client';
import { NO_RHYTHM, type Rhythm } from '../../../web/audio/rhythm/rhythm';
import type { LeaderFile } from '../../../web/motion/retarget/leader';
import type { SolvedMotion } from '../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../web/motion/skeleton/kinematics';
import { SMPL22 } from '../../../web/motion/skeleton/skeleton';
import { uniform } from '../../../web/ui/store/guidance-matrix';
import type { Guidance, LoadedLeader, LoadedSong, Settings } from '../../../web/ui/store/reaction';
import { small } from './small-manifest';

/** Guidance of the small model with the same weights for every body part. */
export function uniformGuidance(coarse: number, fine: number): Guidance {
  return uniform(small.latent.streams, small.latent.layers, (layer) => (layer === 'coarse' ? coarse : fine));
}

/** What a dance of the small model was asked for. */
export const madeSettings: Settings = {
  guidance: uniformGuidance(0, 0),
  music: 2,
  variety: 1,
  seed: 1,
  role: 'reactor',
  height: null,
  holdHands: true,
};

/** A motion without movement, all joints in one place. */
export function still(frames: number): SolvedMotion {
  return {
    fps: 30,
    frames,
    offsets: new Float32Array(66),
    root: new Float32Array(frames * 3),
    rotations: Float32Array.from({ length: frames * 88 }, (_, i) => (i % 4 === 3 ? 1 : 0)),
    positions: new Float32Array(frames * 66),
    fitError: 0.002,
  };
}

export function leaderFile(frames: number, warnings: string[] = [], remarks: string[] = []): LeaderFile {
  return {
    clip: { fps: 30, frames, positions: new Float32Array(frames * 66) },
    report: {
      format: 'BVH',
      parts: [],
      part: 0,
      mappedBy: 'names',
      confidence: 1,
      floor: 0,
      convention: 'Mixamo',
      joints: Object.fromEntries(SMPL22.map((joint) => [joint, joint])),
      estimated: [],
      retargeted: [],
      sourceFps: 60,
      unit: 'centimetres',
      upAxis: 'y',
      halfRate: null,
      warnings,
      remarks,
    } as unknown as LeaderFile['report'],
  };
}

/** A motion of a short-boned dancer in which every number is another one. */
export function numbered(frames: number, from: number): SolvedMotion {
  let value = from;
  const next = (most: number): number => most * Math.sin((value += 0.1));
  const offsets = Float32Array.from({ length: 66 }, () => next(0.1));
  const root = Float32Array.from({ length: frames * 3 }, () => next(1));
  const rotations = new Float32Array(frames * 88);
  for (let at = 0; at < rotations.length; at += 4) {
    const quaternion = [next(1), next(1), next(1), next(1)];
    rotations.set(
      quaternion.map((part) => part / Math.hypot(...quaternion)),
      at,
    );
  }
  const positions = forwardKinematics(offsets, root, rotations);
  return { fps: 30, frames, offsets, root, rotations, positions, fitError: 0.002 };
}

export function leader(
  frames: number,
  name = 'leader_0412.bvh',
  warnings: string[] = [],
  remarks: string[] = [],
): LoadedLeader {
  return {
    name,
    label: null,
    files: [{ name, bytes: new TextEncoder().encode('HIERARCHY') }],
    options: {},
    file: leaderFile(frames, warnings, remarks),
    motion: still(frames),
  };
}

/** The rhythm of beats at these seconds, in bars of four from the first one. */
export function rhythm(beats: readonly number[], more: Partial<Rhythm> = {}): Rhythm {
  const [first = 0, last = 0] = [beats[0], beats.at(-1)];
  const tempo = last > first ? (60 * (beats.length - 1)) / (last - first) : 0;
  return { ...NO_RHYTHM, beats, tempo, slowest: tempo, fastest: tempo, sure: true, ...more };
}

/** A song with a beat each half second. */
export function songData(seconds: number, more: Partial<Song> = {}): Song {
  const frames = Math.round(seconds * 30);
  return {
    duration: seconds,
    waveform: { low: new Int8Array(0), high: new Int8Array(0), rate: 1000, loudest: 0 },
    sound: new Blob(),
    features: new Float32Array(frames * 54),
    frames,
    rhythm: rhythm(Array.from({ length: Math.floor(seconds * 2) }, (_, index) => index / 2)),
    silent: false,
    ...more,
  };
}

export function song(seconds: number, more: Partial<Song> = {}): LoadedSong {
  return { name: 'Descarga.mp3', label: null, file: new Blob(['ID3']), data: songData(seconds, more) };
}
