/** kbit/s by the number in a frame's header: of MPEG 1, and of MPEG 2 and 2.5. */
const BIT_RATES = [
  [32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320],
  [8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160],
] as const;
/** Hz by the number in a frame's header, of MPEG 1. */
const SAMPLE_RATES = [44100, 48000, 32000] as const;
/** What MPEG 2.5, 2 and 1 divide those by, by the number of the version; 1 is none. */
const DIVISORS = [4, null, 2, 1] as const;

/** Seconds and bytes of the frame whose header is in these four bytes; null where they are no header. */
function frameAt(bytes: Uint8Array, at: number): { seconds: number; size: number } | null {
  const [sync = 0, kind = 0, rates = 0] = bytes.subarray(at, at + 4);
  // Eleven bits that are set begin a header; 01 says that it is one of layer III.
  if (sync !== 0xff || (kind & 0xe6) !== 0xe2) return null;
  const divisor = DIVISORS[(kind >> 3) & 3]!;
  const bitRate = BIT_RATES[divisor === 1 ? 0 : 1][(rates >> 4) - 1];
  const sampleRate = SAMPLE_RATES[(rates >> 2) & 3];
  if (divisor === null || bitRate === undefined || sampleRate === undefined) return null;
  const seconds = (divisor === 1 ? 1152 : 576) / (sampleRate / divisor);
  return { seconds, size: Math.floor(seconds * bitRate * 125 + 1e-6) + ((rates >> 1) & 1) };
}

/** Bytes of the ID3 tag, with pictures, at the beginning of a file. */
function tagSize(head: Uint8Array): number {
  if (head.length < 10 || String.fromCharCode(...head.subarray(0, 3)) !== 'ID3') return 0;
  return 10 + head.subarray(6, 10).reduce((size, byte) => size * 128 + (byte & 0x7f), 0);
}

/** Whether a file begins as an MP3 does. */
export function isMp3(head: Uint8Array): boolean {
  return tagSize(head) > 0 || frameAt(head, 0) !== null;
}

/**
 * Duration of an MP3 by all its frames, seconds; 0 where it has none. Without a table of contents browsers guess it from
 * the bit rate of the first frames, which is far lower than the mean where a song begins with silence.
 */
export function mp3Duration(bytes: Uint8Array): number {
  let duration = 0;
  for (let at = tagSize(bytes); at + 4 <= bytes.length;) {
    const frame = frameAt(bytes, at);
    duration += frame?.seconds ?? 0;
    at += frame?.size ?? 1;
  }
  return duration;
}
