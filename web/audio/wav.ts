const HEADER_BYTES = 44;

/**
 * Encodes sound as a 16-bit WAV file.
 *
 * @param channels one array of samples in [-1, 1] for each channel, all of one length; louder samples are clipped
 * @param sampleRate Hz
 */
export function encodeWav(channels: readonly Float32Array[], sampleRate: number): Blob {
  const frames = channels[0]?.length ?? 0;
  const frameBytes = 2 * channels.length;
  const samples = new Int16Array(frames * channels.length);
  channels.forEach((channel, index) => {
    for (let i = 0; i < frames; i++) {
      const sample = 32767 * channel[i]!;
      const clipped = sample > 32767 ? 32767 : sample < -32767 ? -32767 : sample;
      samples[i * channels.length + index] = Math.floor(clipped + 0.5);
    }
  });
  const header = new DataView(new ArrayBuffer(HEADER_BYTES));
  const text = (offset: number, letters: string): void =>
    [...letters].forEach((letter, i) => header.setUint8(offset + i, letter.charCodeAt(0)));
  text(0, 'RIFF');
  header.setUint32(4, HEADER_BYTES - 8 + samples.byteLength, true);
  text(8, 'WAVEfmt ');
  header.setUint32(16, 16, true); // length of the format chunk
  header.setUint16(20, 1, true); // linear PCM
  header.setUint16(22, channels.length, true);
  header.setUint32(24, sampleRate, true);
  header.setUint32(28, sampleRate * frameBytes, true);
  header.setUint16(32, frameBytes, true);
  header.setUint16(34, 16, true); // bits per sample
  text(36, 'data');
  header.setUint32(40, samples.byteLength, true);
  return new Blob([header, samples], { type: 'audio/wav' });
}
