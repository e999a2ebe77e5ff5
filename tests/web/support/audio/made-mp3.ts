/** Numbers of bit rates in the header of a frame of MPEG 1, with the bytes of a frame of 44.1 kHz. */
const FRAMES = { 32: [1, 104], 320: [14, 1044] } as const;
/** Frames of silence, one channel, each of one of the bit rates in kbit/s. */
function silentMp3(rates: readonly (keyof typeof FRAMES)[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(rates.reduce<number>((size, rate) => size + FRAMES[rate][1], 0));
  let at = 0;
  for (const rate of rates) {
    const [number, size] = FRAMES[rate];
    bytes.set([0xff, 0xfb, number << 4, 0xc0], at);
    at += size;
  }
  return bytes;
}

/** A song of 4600 frames, some 120 seconds, without a table of contents whose first ten seconds have a tenth of the bit rate of the rest. */
export function quietlyBegunMp3(): Uint8Array<ArrayBuffer> {
  return silentMp3(Array.from({ length: 4600 }, (_, frame) => (frame < 383 ? 32 : 320)));
}
