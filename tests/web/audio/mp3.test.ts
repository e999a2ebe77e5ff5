import { expect, test } from 'vitest';
import { isMp3, mp3Duration } from '../../../web/audio/mp3';
import { encodeWav } from '../../../web/audio/wav';
import { FRAME_SECONDS, quietlyBegunMp3, silentMp3 } from '../support/audio/made-mp3';

test('all frames of an MP3 count, whatever their bit rates', () => {
  expect(mp3Duration(silentMp3([32, 320, 320]))).toBeCloseTo(3 * FRAME_SECONDS, 9);
  expect(mp3Duration(quietlyBegunMp3())).toBeCloseTo(4600 * FRAME_SECONDS, 6);
});

test('the tag before the frames and what lies between them do not count', () => {
  const tag = new Uint8Array(10 + 200).fill(0xfb);
  tag.set([0x49, 0x44, 0x33, 4, 0, 0, 0, 0, 1, 72]);
  const frames = silentMp3([32, 32]);
  const bytes = Uint8Array.of(...tag, ...frames, 0xff, 0xff, 0, ...frames, 0x54, 0x41, 0x47);
  expect(isMp3(bytes)).toBe(true);
  expect(mp3Duration(bytes)).toBeCloseTo(4 * FRAME_SECONDS, 9);
});

test('MPEG 2 and 2.5 have half the samples a frame', () => {
  // 22050 Hz with 64 kbit/s: 208 bytes; 11025 Hz with 8 kbit/s: 52 bytes.
  const two = new Uint8Array(208);
  two.set([0xff, 0xf3, 0x80, 0xc0]);
  const twoAndHalf = new Uint8Array(52);
  twoAndHalf.set([0xff, 0xe3, 0x10, 0xc0]);
  expect(mp3Duration(Uint8Array.of(...two, ...two))).toBeCloseTo((2 * 576) / 22050, 9);
  expect(mp3Duration(Uint8Array.of(...twoAndHalf, ...twoAndHalf))).toBeCloseTo((2 * 576) / 11025, 9);
});

test('other sounds are no MP3', async () => {
  const wav = new Uint8Array(await encodeWav([new Float32Array(100)], 8000).arrayBuffer());
  expect(isMp3(wav)).toBe(false);
  expect(isMp3(Uint8Array.of(0xff, 0xf1, 0x50, 0x80))).toBe(false);
  expect(isMp3(new Uint8Array())).toBe(false);
});
