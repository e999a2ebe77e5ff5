import {
  AudioSample,
  AudioSampleSource,
  BufferTarget,
  CanvasSource,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  WebMOutputFormat,
} from 'mediabunny';
import { yieldToPage } from '../../common/yield-to-events';
import type { Footage, VideoOptions } from './footage';
import type { VideoPlan } from './plan';
import { decodeSound, songStretch } from './song';

/** Pictures from one that stands for itself to the next: seeking in the video steps from those. */
const KEY_SECONDS = 2;
const SOUND_BITS = 160_000;

/**
 * Writes a video picture by picture with the browser's own encoders, as fast as they and the drawing go. The page
 * stays alive: others have their turn after every picture.
 */
export async function encodeVideo(
  footage: Footage,
  plan: Extract<VideoPlan, { way: 'encode' }>,
  { signal, onProgress }: VideoOptions,
): Promise<Blob> {
  const { fps, frames } = footage;
  const heard = footage.sound && plan.audio && (await decodeSound(footage.sound.file));
  signal.throwIfAborted();
  const target = new BufferTarget();
  const format = plan.container === 'mp4' ? new Mp4OutputFormat() : new WebMOutputFormat();
  const output = new Output({ format, target });
  try {
    const pictures = new CanvasSource(footage.canvas, {
      codec: plan.video,
      bitrate: QUALITY_HIGH,
      keyFrameInterval: KEY_SECONDS,
    });
    output.addVideoTrack(pictures, { frameRate: fps });
    const song =
      heard && plan.audio ? new AudioSampleSource({ codec: plan.audio, bitrate: SOUND_BITS }) : null;
    if (song) output.addAudioTrack(song);
    await output.start();
    let written = 0;
    for (let frame = 0; frame < frames; frame++) {
      signal.throwIfAborted();
      footage.draw(frame);
      await pictures.add(frame / fps, 1 / fps);
      // The song goes along second by second, so that neither track waits long for the other in the file.
      if (song && heard && footage.sound && (frame % fps === 0 || frame === frames - 1)) {
        const until = Math.round((Math.min(frames, frame + fps) / fps) * heard.rate);
        if (until > written) {
          const data = songStretch(heard, footage.sound.start, written, until - written);
          const sample = new AudioSample({
            data,
            format: 'f32-planar',
            numberOfChannels: heard.channels.length,
            sampleRate: heard.rate,
            timestamp: written / heard.rate,
          });
          await song.add(sample);
          sample.close();
          written = until;
        }
      }
      onProgress({ frame: frame + 1, frames });
      await yieldToPage();
    }
    signal.throwIfAborted();
    await output.finalize();
  } catch (error) {
    if (output.state !== 'finalized') await output.cancel().catch(() => undefined);
    throw error;
  }
  if (!target.buffer) throw new Error('The video came out empty.');
  return new Blob([target.buffer], { type: `video/${plan.container}` });
}
