/** Decodes the pictures of a video with their exact times. The only module that reads videos with mediabunny. */
import {
  ALL_FORMATS,
  BlobSource,
  EncodedPacketSink,
  Input,
  type InputTrack,
  type InputVideoTrack,
  VideoSampleSink,
} from 'mediabunny';
import { AppError } from '../common/error';
import type { PictureSize } from '../common/picture';
import { inTime } from '../model/load/in-time';
import { type Picture, PictureCopier, pictureOf } from './pose/picture';

/** Pictures a second that are read of a faster video. */
const MAX_RATE = 30;
/** How much earlier than it is due a picture may come, seconds: rates vary a little. */
const TOLERANCE = 0.25 / MAX_RATE;
/** Longest time to wait for a picture. */
const MAX_WAIT_MS = 30_000;
/** Longest video, seconds. */
const MAX_DURATION = 600;

/** A video that is open. Its times are the file's own, seconds, as a <video> element counts them. */
export interface VideoFile {
  /** Time of the first picture: sound may begin before it. */
  readonly start: number;
  /** When the last picture ends. */
  readonly end: number;
  /** Time of the last picture that the file names: of a file that was cut off, it is not there. */
  readonly last: number;
  readonly width: number;
  readonly height: number;
  /** When its sound begins, as the browser decodes it; null where it has none. */
  readonly soundStart: number | null;
  /**
   * The pictures between two moments in order, at most 30 a second. Each is valid until the next one is asked for.
   * @throws {AppError} `video-damaged` where a picture can't be decoded, `video-stalled` where none comes
   */
  pictures(from: number, to: number): AsyncGenerator<{ readonly time: number; readonly picture: Picture }>;
  /** Ends decoding. */
  close(): void;
}

/**
 * Opens a video.
 * @throws {AppError} `not-a-video`, `sound-only`, `video-insecure`, `video-unread`, `video-codec`, `video-too-long`
 */
export async function openVideo(file: Blob): Promise<VideoFile> {
  const input = new Input({ formats: ALL_FORMATS, source: new BlobSource(file) });
  try {
    const track = await videoTrack(input);
    const start = await shownFrom(track);
    const end = await track.computeDuration();
    const lastPacket = await new EncodedPacketSink(track).getPacket(Infinity, { metadataOnly: true });
    // A WebM file that is cut off in its first part has a header, and no picture that could be read.
    if (!lastPacket) throw notAVideo();
    if (end - start > MAX_DURATION) throw tooLong(end - start);
    const sound = await input.getPrimaryAudioTrack();
    const size = { width: await track.getDisplayWidth(), height: await track.getDisplayHeight() };
    return {
      start,
      end,
      last: lastPacket.timestamp,
      ...size,
      soundStart: sound && (await shownFrom(sound)),
      pictures: (from, to) => pictures(track, size, from, to),
      close: () => {
        input.dispose();
      },
    };
  } catch (error) {
    input.dispose();
    throw error;
  }
}

/** When a track begins to be played. What was cut off without a loss is still in the file, at times below 0. */
async function shownFrom(track: InputTrack): Promise<number> {
  return Math.max(0, await track.getFirstTimestamp());
}

async function videoTrack(input: Input): Promise<InputVideoTrack> {
  let track: InputVideoTrack | null;
  try {
    track = await input.getPrimaryVideoTrack();
  } catch (cause) {
    throw notAVideo({ cause });
  }
  if (!track) {
    if (!(await input.getPrimaryAudioTrack())) throw notAVideo();
    throw new AppError(
      'sound-only',
      'This file holds sound and no pictures.',
      'Choose a video of a dancer, or use the file as the song.',
    );
  }
  if (!('VideoDecoder' in globalThis)) throw noDecoder();
  if (!(await track.canDecode().catch(() => false))) throw undecodable(await codecOf(track));
  return track;
}

/** As it is commonly called, else as the file calls it; null where that is not text. */
async function codecOf(track: InputVideoTrack): Promise<string | null> {
  const codec = (await track.getCodec()) ?? (await track.getInternalCodecId());
  return typeof codec === 'string' ? codec : null;
}

/** Tells of each picture of a video, by its time in seconds, whether it is read: at most 30 a second are. */
export function pictureChoice(): (time: number) => boolean {
  let due = -Infinity;
  return (time) => {
    if (time < due - TOLERANCE) return false;
    due = Math.max(due, time) + 1 / MAX_RATE;
    return true;
  };
}

async function* pictures(
  track: InputVideoTrack,
  size: PictureSize,
  from: number,
  to: number,
): AsyncGenerator<{ readonly time: number; readonly picture: Picture }> {
  const sink = new VideoSampleSink(track);
  const isRead = pictureChoice();
  const copier = new PictureCopier();
  let time = Math.max(0, from);
  try {
    for await (const sample of unlessStalled(sink.samples(time, to))) {
      try {
        time = sample.timestamp;
        if (time < 0 || !isRead(time)) continue;
        yield { time, picture: copier.copyOf(pictureOf(sample, size)) };
      } finally {
        sample.close();
      }
    }
  } catch (cause) {
    throw cause instanceof AppError ? cause : damaged(time, cause);
  }
}

/**
 * What comes from a decoder, in order.
 * @throws {AppError} `video-stalled` where nothing comes for `MAX_WAIT_MS`: WebKitGTK waits forever at the time 0 of a
 *   video that was cut without a loss
 */
export async function* unlessStalled<T>(decoded: AsyncIterator<T, unknown>): AsyncGenerator<T> {
  try {
    for (;;) {
      const next = await inTime(decoded.next(), MAX_WAIT_MS, stalled);
      if (next.done) return;
      yield next.value;
    }
  } finally {
    await decoded.return?.();
  }
}

function notAVideo(options?: ErrorOptions): AppError {
  return new AppError(
    'not-a-video',
    'This file holds no video that could be read.',
    'If it plays elsewhere, convert it to MP4. If not, copy or download it again: its end may be missing.',
    options,
  );
}

/** WebCodecs are missing: they are offered over https only, and not by every browser. */
function noDecoder(): AppError {
  if (!isSecureContext)
    return new AppError(
      'video-insecure',
      'Videos can be read over https or on localhost only.',
      'Open this page at an address that begins with https, or choose a motion file.',
    );
  return new AppError(
    'video-unread',
    'This browser cannot read videos for a page.',
    'Open the page in a new version of Chrome, Edge or Safari, or choose a motion file.',
  );
}

function undecodable(codec: string | null): AppError {
  // What phones record unless they are told otherwise.
  if (codec === 'hevc')
    return new AppError(
      'video-codec',
      'This browser cannot decode the video’s codec (HEVC, also called H.265).',
      'Convert it to H.264 MP4, or open the page in Safari. To film in H.264, choose Settings > Camera > Formats > ' +
        'Most Compatible on an iPhone, or turn off HEVC or “high efficiency” in the camera’s settings on Android.',
    );
  // Such as 10 bits or all colours, which cameras and editors write; a codec of the usual kind every browser has.
  if (codec === 'avc')
    return new AppError(
      'video-codec',
      'This browser cannot decode this kind of H.264.',
      'Save the video as H.264 MP4 with 8 bits and 4:2:0 (yuv420p), or open the page in another browser.',
    );
  return new AppError(
    'video-codec',
    `This browser cannot decode the video’s codec${codec ? ` (${codec})` : ''}.`,
    'Save the video as H.264 MP4 or as VP9 WebM, or open the page in another browser.',
  );
}

function stalled(): AppError {
  return new AppError(
    'video-stalled',
    'This browser has stopped decoding the video.',
    'Open the page in another browser, or save the video anew with a program that edits videos, then choose that.',
  );
}

function damaged(time: number, cause: unknown): AppError {
  return new AppError(
    'video-damaged',
    `The video cannot be decoded after ${Math.max(0, time).toFixed(1)} s: it is damaged there.`,
    'Copy or download it again, or cut out a part that plays, then choose that.',
    { cause },
  );
}

function tooLong(duration: number): AppError {
  return new AppError(
    'video-too-long',
    `The video lasts ${Math.round(duration / 60)} minutes; at most ${MAX_DURATION / 60} can be read.`,
    'Cut out the dance in your phone or computer first, then choose the shorter video.',
  );
}
