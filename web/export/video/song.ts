import { AppError } from '../../common/error';

/** Sample rate at which songs are decoded, that of Opus, Hz. */
const SAMPLE_RATE_HZ = 48_000;

/** Decoded sound: sample rate in Hz, one or two channels of the same length. */
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
    const buffer = await new OfflineAudioContext(1, 1, SAMPLE_RATE_HZ).decodeAudioData(bytes);
    const channels = Array.from({ length: buffer.numberOfChannels }, (_, i) => buffer.getChannelData(i));
    return { rate: buffer.sampleRate, channels: channels.length > 2 ? [mixedDown(channels)] : channels };
  } catch (cause) {
    throw new AppError(
      'sound-failed',
      'The song could not be read for the video.',
      'Load the song again and save the video once more, or remove the song.',
      { cause },
    );
  }
}

function mixedDown(channels: readonly Float32Array[]): Float32Array {
  const out = new Float32Array(channels[0]?.length ?? 0);
  for (const channel of channels) channel.forEach((sample, i) => (out[i]! += sample / channels.length));
  return out;
}

/**
 * Samples of the sound during the dance, all channels one after the other, silence where there is no song.
 *
 * @param start moment of the dance at which the song begins, seconds; may be negative
 * @param from first sample, counted from the start of the dance
 * @param length number of samples of a channel
 */
export function songSamples(sound: Sound, start: number, from: number, length: number): Float32Array {
  const out = new Float32Array(length * sound.channels.length);
  const first = from - Math.round(start * sound.rate);
  sound.channels.forEach((channel, row) => {
    const [begin, end] = [Math.max(0, first), Math.min(channel.length, first + length)];
    if (end > begin) out.set(channel.subarray(begin, end), row * length + begin - first);
  });
  return out;
}
