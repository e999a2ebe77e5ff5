import type { PictureSize } from '../../common/picture';
import type { AudioCodec, VideoCodec } from 'mediabunny';
import { canEncodeAudio, canEncodeVideo, Mp4OutputFormat, WebMOutputFormat } from 'mediabunny';
import { canEncodeAac } from './aac';

type Container = 'mp4' | 'webm';

/** How a video will be written. */
export type VideoPlan =
  | {
      /** Frame by frame with WebCodecs, as fast as the machine can. */
      readonly way: 'encode';
      readonly container: Container;
      readonly video: VideoCodec;
      readonly audio: AudioCodec | null;
    }
  | {
      /** In real time with a MediaRecorder, in browsers without WebCodecs. */
      readonly way: 'record';
      readonly container: Container;
      readonly type: string;
    };

/** In order of preference: MP4 only with the two codecs that every player of MP4 supports, else WebM. */
const ENCODED = [
  { container: 'mp4', video: 'avc', audio: 'aac' },
  { container: 'webm', video: 'vp9', audio: 'opus' },
  { container: 'webm', video: 'vp8', audio: 'opus' },
  { container: 'webm', video: 'av1', audio: 'opus' },
] as const;

const RECORDED = [
  { container: 'mp4', type: 'video/mp4;codecs=avc1.42E01F,mp4a.40.2' },
  { container: 'webm', type: 'video/webm;codecs=vp9,opus' },
  { container: 'webm', type: 'video/webm;codecs=vp8,opus' },
  { container: 'webm', type: 'video/webm' },
  { container: 'mp4', type: 'video/mp4' },
] as const;

/** The first way of writing a video that this browser supports; null when there is none. */
export async function plan(size: PictureSize, withSound: boolean): Promise<VideoPlan | null> {
  return (await encodePlan(size, withSound)) ?? recordPlan();
}

async function encodePlan({ width, height }: PictureSize, withSound: boolean): Promise<VideoPlan | null> {
  if (!('VideoEncoder' in globalThis)) return null;
  for (const { container, video, audio } of ENCODED) {
    const canVideo = await canEncodeVideo(video, { width, height });
    if (!canVideo) continue;
    const canAudio = !withSound || (audio === 'aac' ? await canEncodeAac() : await canEncodeAudio(audio));
    if (canAudio) return { way: 'encode', container, video, audio: withSound ? audio : null };
  }
  return null;
}

function recordPlan(): VideoPlan | null {
  if (!('MediaRecorder' in globalThis) || !('captureStream' in HTMLCanvasElement.prototype)) return null;
  const supported = RECORDED.find(({ type }) => MediaRecorder.isTypeSupported(type));
  return supported ? { way: 'record', ...supported } : null;
}

/** What writes the files of a plan. */
export function outputFormat({ container }: VideoPlan): Mp4OutputFormat | WebMOutputFormat {
  return container === 'mp4' ? new Mp4OutputFormat() : new WebMOutputFormat();
}
