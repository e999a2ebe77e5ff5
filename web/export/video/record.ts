import { ALL_FORMATS, BlobSource, BufferTarget, Conversion, Input, Output } from 'mediabunny';
import { AUDIO_BITRATE, type VideoOptions, type VideoSource } from './source';
import { outputFormat, type VideoPlan } from './plan';
import { decodeSound, type Sound, songSamples } from './song';

/** Bits per second. */
const VIDEO_BITRATE = 8_000_000;

type RecordPlan = Extract<VideoPlan, { way: 'record' }>;

/**
 * Records a video in real time, for browsers without WebCodecs. Frames that are drawn too slowly are left out.
 * @throws {AppError} `sound-failed`; what the drawing throws; the signal's reason; an error where the recorder fails
 */
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
  let context: AudioContext | null = null;
  let recorded: Blob;
  try {
    let song: Song | null = null;
    if (soundtrack) {
      const { sound, start } = soundtrack;
      context = new AudioContext({ sampleRate: sound.rate });
      song = songInto(stream, context, sound, start, frames / fps);
    }
    recorded = await record(stream, plan, async (early) => {
      const ended = AbortSignal.any([signal, early]);
      await song?.start();
      await drawInTime(source, ended, onProgress);
    });
  } finally {
    for (const track of stream.getTracks()) track.stop();
    await context?.close();
  }
  // Nobody has to wait for the recording again because it could not be copied.
  return withDuration(recorded, plan).catch(() => recorded);
}

/**
 * Records a stream while something is drawn.
 * @param draw its signal is aborted when the recorder ends before it
 */
async function record(
  stream: MediaStream,
  plan: RecordPlan,
  draw: (early: AbortSignal) => Promise<void>,
): Promise<Blob> {
  const recorder = new MediaRecorder(stream, {
    mimeType: plan.type,
    videoBitsPerSecond: VIDEO_BITRATE,
    audioBitsPerSecond: AUDIO_BITRATE,
  });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const early = new AbortController();
  const stopped = new Promise<void>((resolve, reject) => {
    const error = new Error('The recorder stopped.');
    recorder.onstop = () => {
      resolve();
      early.abort(error);
    };
    recorder.onerror = () => {
      reject(error);
      early.abort(error);
    };
  });
  // The await below handles an error; until then it must not count as unhandled.
  stopped.catch(() => undefined);
  try {
    recorder.start(1000);
    await draw(early.signal);
    recorder.stop();
    await stopped;
  } finally {
    if (recorder.state !== 'inactive') recorder.stop();
  }
  return new Blob(parts, { type: `video/${plan.container}` });
}

/** Draws the frames when they are due; those whose time has passed are left out. */
async function drawInTime(
  { fps, frames, draw }: VideoSource,
  signal: AbortSignal,
  onProgress: VideoOptions['onProgress'],
): Promise<void> {
  const begin = performance.now();
  for (let frame = 0; frame < frames;) {
    signal.throwIfAborted();
    await draw(frame);
    onProgress(frame + 1);
    const next = Math.max(frame + 1, Math.floor(((performance.now() - begin) / 1000) * fps));
    await pause((next / fps) * 1000 - (performance.now() - begin));
    frame = next;
  }
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

interface Song {
  readonly start: () => Promise<void>;
}

/** Adds the song of the whole dance to a stream, without playing it on the page. */
function songInto(
  stream: MediaStream,
  context: AudioContext,
  sound: Sound,
  start: number,
  seconds: number,
): Song {
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
    start: async () => {
      await context.resume();
      player.start();
    },
  };
}

function pause(milliseconds: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));
}
