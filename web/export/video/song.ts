import { AppError } from '../../common/error';

/** Hz at which songs are decoded: what Opus works at. */
const RATE = 48_000;

/** Decoded sound, one or two channels of one length. */
export interface Sound {
  readonly rate: number;
  readonly channels: readonly Float32Array[];
}

/**
 * Decodes a song. Two channels stay two; more than two are mixed into one.
 *
 * @throws {AppError} `sound-failed`
 */
export async function decodeSound(file: Blob): Promise<Sound> {
  try {
    const bytes = await file.arrayBuffer();
    const buffer = await new OfflineAudioContext(1, 1, RATE).decodeAudioData(bytes);
    const channels = Array.from({ length: buffer.numberOfChannels }, (_, i) => buffer.getChannelData(i));
    return { rate: buffer.sampleRate, channels: channels.length > 2 ? [mixed(channels)] : channels };
  } catch (cause) {
    throw new AppError(
      'sound-failed',
      'The song could not be read for the video.',
      'Load the song again and save the video once more, or remove the song.',
      { cause },
    );
  }
}

function mixed(channels: readonly Float32Array[]): Float32Array {
  const out = new Float32Array(channels[0]?.length ?? 0);
  for (const channel of channels) channel.forEach((sample, i) => (out[i]! += sample / channels.length));
  return out;
}

/**
 * A stretch of what is heard during the dance, all channels one after the other, silence where there is no song.
 *
 * @param start moment of the dance at which the song begins, seconds; may be negative
 * @param from first sample of the stretch, counted from the beginning of the dance
 * @param length samples
 */
export function songStretch(sound: Sound, start: number, from: number, length: number): Float32Array {
  const out = new Float32Array(length * sound.channels.length);
  const first = from - Math.round(start * sound.rate);
  sound.channels.forEach((channel, row) => {
    const [begin, end] = [Math.max(0, first), Math.min(channel.length, first + length)];
    if (end > begin) out.set(channel.subarray(begin, end), row * length + begin - first);
  });
  return out;
}
