import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { readFloats, type ReferenceSong } from './audio-fixtures';

const repository = fileURLToPath(new URL('../../../../', import.meta.url));
/** Folder of the real songs, whether it is there or not. */
export const realSongFolder = join(repository, '../shared/data/music');
const python = join(repository, '.venv/bin/python');

/** Names of the songs beside the repository; empty when the folder is not there. */
export const realSongs: string[] = existsSync(realSongFolder)
  ? readdirSync(realSongFolder)
      .filter((name) => /\.(ogg|opus|mp3|flac|wav)$/.test(name))
      .sort()
  : [];

/** Why the real songs can't be compared here; null when they can. */
export const absence: string | null =
  realSongs.length === 0
    ? 'real data not present'
    : existsSync(python)
      ? null
      : 'Python environment not present';

/** Decodes real songs to mono samples at the recipe's rate: about a second for a minute of music. */
export function decodeRealSongs(names: readonly string[]): Float32Array[] {
  const out = mkdtempSync(join(tmpdir(), 'songs-'));
  const decode = [
    'import sys',
    'from training.music.features import load_audio',
    'from training.music.recipe import AudioRecipe',
    'for index, name in enumerate(sys.argv[2:]):',
    '    load_audio(name, AudioRecipe()).astype("<f4").tofile(f"{sys.argv[1]}/{index}.pcm")',
  ].join('\n');
  try {
    const files = names.map((name) => join(realSongFolder, name));
    execFileSync(python, ['-c', decode, out, ...files], { cwd: repository });
    return names.map((_, index) => readFloats(join(out, `${index}.pcm`)));
  } finally {
    rmSync(out, { recursive: true });
  }
}

/** Decodes real songs and computes their features with Python: about five seconds for a minute of music. */
export function loadRealSongs(names: readonly string[]): ReferenceSong[] {
  const out = mkdtempSync(join(tmpdir(), 'songs-'));
  try {
    const files = names.map((name) => join(realSongFolder, name));
    execFileSync(python, ['-m', 'tests.fixtures.song_features', out, ...files], {
      cwd: repository,
      // More threads only wait for each other beside other tests.
      env: { ...process.env, OMP_NUM_THREADS: '1', OPENBLAS_NUM_THREADS: '1' },
    });
    const tempi = JSON.parse(readFileSync(join(out, 'tempo.json'), 'utf8')) as number[];
    return names.map((name, index) => ({
      name,
      audio: readFloats(join(out, `${index}.pcm`)),
      features: readFloats(join(out, `${index}.f32`)),
      tempo: tempi[index]!,
    }));
  } finally {
    rmSync(out, { recursive: true });
  }
}
