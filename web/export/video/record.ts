import type { Footage, VideoOptions } from './footage';
import type { VideoPlan } from './plan';
import { decodeSound, type Sound, songStretch } from './song';

const PICTURE_BITS = 8_000_000;
const SOUND_BITS = 160_000;

/** Records a video in real time, for browsers whose pages may not encode: what is slow to draw is drawn less often. */
export async function recordVideo(
  footage: Footage,
  plan: Extract<VideoPlan, { way: 'record' }>,
  { signal, onProgress }: VideoOptions,
): Promise<Blob> {
  const { fps, frames } = footage;
  const heard = footage.sound && { sound: await decodeSound(footage.sound.file), start: footage.sound.start };
  signal.throwIfAborted();
  const stream = footage.canvas.captureStream(fps);
  const song = heard && playInto(stream, heard.sound, heard.start, frames / fps);
  const recorder = new MediaRecorder(stream, {
    mimeType: plan.type,
    videoBitsPerSecond: PICTURE_BITS,
    audioBitsPerSecond: SOUND_BITS,
  });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const stopped = new Promise<void>((resolve, reject) => {
    recorder.onstop = () => {
      resolve();
    };
    recorder.onerror = () => {
      reject(new Error('The recorder stopped.'));
    };
  });
  // An error is told by the await below; nobody may be listening yet.
  stopped.catch(() => undefined);
  try {
    recorder.start(1000);
    await song?.start();
    const begin = performance.now();
    for (let frame = 0; frame < frames;) {
      signal.throwIfAborted();
      footage.draw(frame);
      onProgress({ frame: frame + 1, frames });
      const next = Math.max(frame + 1, Math.floor(((performance.now() - begin) / 1000) * fps));
      await pause((next / fps) * 1000 - (performance.now() - begin));
      frame = next;
    }
    recorder.stop();
    await stopped;
  } finally {
    if (recorder.state !== 'inactive') recorder.stop();
    for (const track of stream.getTracks()) track.stop();
    await song?.stop();
  }
  return new Blob(parts, { type: `video/${plan.container}` });
}

/** Adds the song of the whole dance to a stream; nothing of it is heard on the page. */
function playInto(stream: MediaStream, sound: Sound, start: number, seconds: number) {
  const context = new AudioContext({ sampleRate: sound.rate });
  const length = Math.round(seconds * sound.rate);
  const whole = songStretch(sound, start, 0, length);
  const buffer = context.createBuffer(sound.channels.length, length, sound.rate);
  sound.channels.forEach((_, i) => {
    buffer.copyToChannel(new Float32Array(whole.subarray(i * length, (i + 1) * length)), i);
  });
  const output = context.createMediaStreamDestination();
  for (const track of output.stream.getAudioTracks()) stream.addTrack(track);
  const source = context.createBufferSource();
  source.buffer = buffer;
  source.connect(output);
  return {
    async start(): Promise<void> {
      await context.resume();
      source.start();
    },
    stop: () => context.close(),
  };
}

function pause(milliseconds: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));
}
