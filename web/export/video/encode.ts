import {
  AudioSample,
  AudioSampleSource,
  BufferTarget,
  CanvasSource,
  Output,
  QUALITY_HIGH,
  type VideoEncodingConfig,
} from 'mediabunny';
import { yieldToPage } from '../../common/yield-to-events';
import { outputFormat, type VideoPlan } from './plan';
import { decodeSound, songSamples, type Sound } from './song';
import { AUDIO_BITRATE, type VideoOptions, type VideoSource } from './source';

type EncodePlan = Extract<VideoPlan, { way: 'encode' }>;

/** Time between key frames, from which seeking in the video starts, seconds. */
const KEY_FRAME_INTERVAL = 2;

/**
 * Has H.264 encoded with its parameter sets in the stream (Annex B), from which the muxer writes the file's decoder
 * record. Firefox's own record has a byte too many in each of them (bug 2031056): QuickTime and Windows refuse the file.
 */
const PARAMETERS_IN_STREAM: Pick<VideoEncodingConfig, 'onEncoderConfig' | 'onEncodedPacket'> = {
  onEncoderConfig: (config) => {
    config.avc = { format: 'annexb' };
  },
  onEncodedPacket: (_, meta) => {
    // Firefox gives an empty record instead of none.
    if (meta?.decoderConfig?.description?.byteLength === 0) delete meta.decoderConfig.description;
  },
};

/**
 * Writes a video frame by frame with the browser's own encoders, as fast as encoding and drawing allow. The page stays
 * responsive: it gets a turn after every frame.
 */
export async function encodeVideo(
  source: VideoSource,
  plan: EncodePlan,
  { signal, onProgress }: VideoOptions,
): Promise<Blob> {
  const { fps, frames } = source;
  const sound = source.sound && plan.audio && (await decodeSound(source.sound.file));
  signal.throwIfAborted();
  const target = new BufferTarget();
  const output = new Output({ format: outputFormat(plan), target });
  try {
    const pictures = new CanvasSource(source.canvas, {
      codec: plan.video,
      bitrate: QUALITY_HIGH,
      keyFrameInterval: KEY_FRAME_INTERVAL,
      ...(plan.video === 'avc' && PARAMETERS_IN_STREAM),
    });
    output.addVideoTrack(pictures, { frameRate: fps });
    const audio = sound && source.sound ? addAudio(output, plan, sound, source.sound.start) : null;
    await output.start();
    for (let frame = 0; frame < frames; frame++) {
      signal.throwIfAborted();
      await source.draw(frame);
      await pictures.add(frame / fps, 1 / fps);
      // Sound is added second by second, so that neither track is far behind the other in the file.
      if (audio && frame % fps === 0) await audio.writeUntil(Math.min(frames, frame + fps) / fps);
      onProgress(frame + 1);
      await yieldToPage();
    }
    signal.throwIfAborted();
    await output.finalize();
  } catch (error) {
    if (output.state !== 'finalized') await output.cancel().catch(() => undefined);
    throw error;
  }
  if (!target.buffer) throw new Error('The encoded video is empty.');
  return new Blob([target.buffer], { type: `video/${plan.container}` });
}

/** Adds an audio track with the song, which begins at the moment `start` of the dance, in seconds. */
function addAudio(output: Output, plan: EncodePlan, sound: Sound, start: number) {
  if (!plan.audio) return null;
  const track = new AudioSampleSource({ codec: plan.audio, bitrate: AUDIO_BITRATE });
  output.addAudioTrack(track);
  let written = 0;
  return {
    /** Writes the samples up to a moment of the dance, seconds. */
    async writeUntil(seconds: number): Promise<void> {
      const until = Math.round(seconds * sound.rate);
      if (until <= written) return;
      const sample = new AudioSample({
        data: songSamples(sound, start, written, until - written),
        format: 'f32-planar',
        numberOfChannels: sound.channels.length,
        sampleRate: sound.rate,
        timestamp: written / sound.rate,
      });
      await track.add(sample);
      sample.close();
      written = until;
    },
  };
}
