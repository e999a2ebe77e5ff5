import { ALL_FORMATS, BlobSource, BufferTarget, Conversion, Input, Output } from 'mediabunny';
import type { VideoSource, VideoOptions } from './source';
import { outputFormat, type VideoPlan } from './plan';
import { decodeSound, type Sound, songSamples } from './song';

/** Bits per second. */
const VIDEO_BITRATE = 8_000_000;
const AUDIO_BITRATE = 160_000;

type RecordPlan = Extract<VideoPlan, { way: 'record' }>;

/** Records a video in real time, for browsers without WebCodecs. Frames that are drawn too slowly are left out. */
export async function recordVideo(
  source: VideoSource,
  plan: RecordPlan,
  { signal, onProgress }: VideoOptions,
): Promise<Blob> {
  const { fps, frames } = source;
  const soundtrack = source.sound && {
    sound: await decodeSound(source.sound.file),
    start: source.sound.start,
  };
  signal.throwIfAborted();
  const stream = source.canvas.captureStream(fps);
  const song = soundtrack && playInto(stream, soundtrack.sound, soundtrack.start, frames / fps);
  const recorder = new MediaRecorder(stream, {
    mimeType: plan.type,
    videoBitsPerSecond: VIDEO_BITRATE,
    audioBitsPerSecond: AUDIO_BITRATE,
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
  // The await below handles an error; until then it must not count as unhandled.
  stopped.catch(() => undefined);
  try {
    recorder.start(1000);
    await song?.start();
    const begin = performance.now();
    for (let frame = 0; frame < frames;) {
      signal.throwIfAborted();
      await source.draw(frame);
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
  const recorded = new Blob(parts, { type: `video/${plan.container}` });
  // Nobody has to wait for the recording again because it could not be copied.
  return withDuration(recorded, plan).catch(() => recorded);
}

/** The same pictures and sound in a file that says how long it is and where to seek, which recorders leave out. */
async function withDuration(recorded: Blob, plan: RecordPlan): Promise<Blob> {
  const input = new Input({ source: new BlobSource(recorded), formats: ALL_FORMATS });
  const target = new BufferTarget();
  const output = new Output({ format: outputFormat(plan), target });
  try {
    const conversion = await Conversion.init({ input, output, copy: { mode: 'forced' } });
    if (conversion.discardedTracks.length > 0) return recorded;
    await conversion.execute();
  } finally {
    input.dispose();
  }
  if (!target.buffer) throw new Error('The copy of the video is empty.');
  return new Blob([target.buffer], { type: recorded.type });
}

/** Adds the song of the whole dance to a stream, without playing it on the page. */
function playInto(stream: MediaStream, sound: Sound, start: number, seconds: number) {
  const context = new AudioContext({ sampleRate: sound.rate });
  const length = Math.round(seconds * sound.rate);
  const whole = songSamples(sound, start, 0, length);
  const buffer = context.createBuffer(sound.channels.length, length, sound.rate);
  sound.channels.forEach((_, i) => {
    buffer.copyToChannel(new Float32Array(whole.subarray(i * length, (i + 1) * length)), i);
  });
  const output = context.createMediaStreamDestination();
  for (const track of output.stream.getAudioTracks()) stream.addTrack(track);
  const player = context.createBufferSource();
  player.buffer = buffer;
  player.connect(output);
  return {
    async start(): Promise<void> {
      await context.resume();
      player.start();
    },
    stop: () => context.close(),
  };
}

function pause(milliseconds: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));
}
