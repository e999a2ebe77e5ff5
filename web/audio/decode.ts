import { AppError } from '../common/error';

/**
 * Hz at which songs are decoded and played: a common rate, and so far above the recipe's that the browser's own
 * resampling does not change the frequencies that are analysed.
 */
const DECODING_RATE = 48000;

/** Largest duration of a song, seconds: decoded sound needs 23 MB a minute. */
const MAX_DURATION = 15 * 60;

/** How long to wait for the duration in a file's header. */
const HEADER_TIMEOUT_MS = 5000;

/** Bytes that `isPlaylist` looks at. */
const PLAYLIST_HEAD_BYTES = 512;

const PLAYLIST = /^(#EXT|\[playlist\]|(<\?xml[^]*)?<(playlist|asx|smil|mpd)|(https?|file|rtsp):\/\/)/i;

/** A song as the browser decodes it. */
export interface DecodedSong {
  /** Samples of each channel, all of one length; the caller may transfer them to a worker. */
  readonly channels: Float32Array<ArrayBuffer>[];
  /** Hz */
  readonly sampleRate: number;
  /** Seconds. */
  readonly duration: number;
}

/**
 * Decodes any audio file that the browser supports, also the sound of a video. Runs on the page only: workers have no
 * decoder.
 *
 * Encoders put silence before an MP3, M4A or Opus song. Chromium removes it where the file says how much (measured:
 * no offset against the same song as WAV); an MP3 without a LAME header stays about 25 ms late, less than one frame.
 *
 * @throws {AppError} empty-file, unreadable-file, too-long, not-audio, no-sound
 */
export async function decodeSong(file: Blob): Promise<DecodedSong> {
  if (file.size === 0) {
    throw new AppError(
      'empty-file',
      'The song file is empty.',
      'Choose another file, or copy this one again.',
    );
  }
  const head = new Uint8Array(await readBytes(file.slice(0, PLAYLIST_HEAD_BYTES)));
  if (isPlaylist(head)) {
    throw new AppError(
      'not-audio',
      'The file is a playlist: it names songs, but contains none.',
      'Choose the file of the song itself.',
    );
  }
  const stated = await headerDuration(file);
  if (stated > MAX_DURATION) checkDuration((await countedDuration(file)) || stated);
  const buffer = await decode(await readBytes(file));
  if (buffer.length === 0) {
    throw new AppError(
      'no-sound',
      'The song file holds no sound.',
      'Choose a file that plays in a music player.',
    );
  }
  checkDuration(buffer.duration);
  // The buffer's own memory, not a copy: ten minutes are 230 MB, and copying them takes over 0.1 s of the page.
  const channels = Array.from({ length: buffer.numberOfChannels }, (_, index) =>
    buffer.getChannelData(index),
  );
  return { channels, sampleRate: buffer.sampleRate, duration: buffer.duration };
}

/**
 * Whether a file is a list of songs (M3U, HLS, PLS, XSPF, ASX, SMIL, DASH) instead of a song. A media element that gets
 * one asks the addresses in it.
 *
 * @param head its first bytes
 */
export function isPlaylist(head: Uint8Array): boolean {
  return PLAYLIST.test(new TextDecoder().decode(head).trimStart());
}

/** @throws {AppError} too-long */
function checkDuration(duration: number): void {
  if (duration <= MAX_DURATION) return;
  const minutes = (duration / 60).toFixed(1);
  throw new AppError(
    'too-long',
    `The song lasts ${minutes} minutes; songs of up to ${MAX_DURATION / 60} minutes can be used.`,
    'Cut out the part to dance to with a sound editor and load that.',
  );
}

/** Duration in the file's header, seconds, without decoding the file; 0 when the header has none. */
async function headerDuration(file: Blob): Promise<number> {
  const address = URL.createObjectURL(file);
  const element = new Audio();
  element.preload = 'metadata';
  try {
    return await new Promise<number>((resolve) => {
      setTimeout(resolve, HEADER_TIMEOUT_MS, 0);
      element.onerror = () => resolve(0);
      element.onloadedmetadata = () => resolve(Number.isFinite(element.duration) ? element.duration : 0);
      element.src = address;
    });
  } finally {
    element.removeAttribute('src');
    URL.revokeObjectURL(address);
  }
}

/**
 * Duration by all packets of a file, seconds; 0 where they cannot be read. Of an MP3 without a table of contents browsers
 * guess it from the first frames, several times too long where a song begins with silence.
 */
async function countedDuration(file: Blob): Promise<number> {
  const { ALL_FORMATS, BlobSource, Input } = await import('mediabunny');
  const input = new Input({ source: new BlobSource(file), formats: ALL_FORMATS });
  return input
    .computeDuration()
    .catch(() => 0)
    .finally(() => {
      input.dispose();
    });
}

async function readBytes(file: Blob): Promise<ArrayBuffer> {
  try {
    return await file.arrayBuffer();
  } catch (cause) {
    throw new AppError(
      'unreadable-file',
      'The song file could not be read.',
      'Check that it has not been moved or changed since it was chosen, and choose it again.',
      { cause },
    );
  }
}

async function decode(bytes: ArrayBuffer): Promise<AudioBuffer> {
  try {
    return await new OfflineAudioContext(1, 1, DECODING_RATE).decodeAudioData(bytes);
  } catch (cause) {
    throw new AppError(
      'not-audio',
      'This browser cannot decode the sound in this file.',
      'Save the song as MP3, or as WAV with 16 bits, which every browser can decode.',
      { cause },
    );
  }
}
