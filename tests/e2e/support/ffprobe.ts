import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import ffprobe from '@ffprobe-installer/ffprobe';

/** What FFmpeg finds in a film. */
export interface Probed {
  readonly format: { readonly format_name: string; readonly duration?: string; readonly size: string };
  readonly streams: readonly {
    readonly codec_type: 'video' | 'audio';
    readonly codec_name: string;
    readonly width?: number;
    readonly height?: number;
    readonly channels?: number;
    /** Frames that could be decoded, for a film; packets with sound otherwise. */
    readonly nb_read_frames: string;
  }[];
}

const run = promisify(execFile);

/** Decodes all of a film and tells what is in it; damage is an error. */
export async function probe(file: string): Promise<Probed> {
  const args = ['-v', 'error', '-count_frames', '-show_format', '-show_streams', '-of', 'json', file];
  const { stdout, stderr } = await run(ffprobe.path, args);
  if (stderr) throw new Error(stderr);
  return JSON.parse(stdout) as Probed;
}
