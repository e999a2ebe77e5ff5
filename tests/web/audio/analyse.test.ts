import { describe, expect, it } from 'vitest';
import { analyse, mixDown } from '../../../web/audio/analyse';
import { encodeWav } from '../../../web/audio/wav';
import { recipe, songs } from '../support/audio/audio-fixtures';
import { processorSeconds } from '../support/processor-time';

const second = 48000;
const ignore = (): void => undefined;

describe('what is computed from decoded samples', () => {
  it('mixes channels to their mean', () => {
    const mono = mixDown([Float32Array.of(1, 0, -1), Float32Array.of(0, 0.5, -1)], 0.01);
    expect(Array.from(mono)).toEqual([0.5, 0.25, -1]);
  });

  it('takes one of two channels that cancel each other out, as without the voice', () => {
    const left = Float32Array.of(0.5, 0.25, -1);
    const right = left.map((sample) => -0.999 * sample);
    expect(mixDown([left, right], 0.01)).toEqual(left);
    expect(mixDown([Float32Array.of(0, 0, 0), left], 0.01)).toEqual(left.map((sample) => sample / 2));
    const tone = Float32Array.from({ length: second }, (_, i) => 0.5 * Math.sin(i / 10));
    const { silent } = analyse([tone, tone.map((sample) => -sample)], second, recipe, ignore);
    expect(silent).toBe(false);
  });

  it('is as long as the song', () => {
    const { waveform, frames, sound } = analyse([new Float32Array(2 * second)], second, recipe, ignore);
    expect(waveform.high).toHaveLength(2 * waveform.rate);
    expect(frames).toBe(61);
    expect(sound.size).toBe(44 + 2 * 2 * second);
  });

  it('flags a silent song', () => {
    const quiet = Float32Array.from({ length: second }, (_, i) => 5e-5 * Math.sin(i / 10));
    expect(analyse([quiet], second, recipe, ignore).silent).toBe(true);
    const loud = quiet.map((sample) => sample * 100);
    const { silent } = analyse([loud], second, recipe, ignore);
    expect(silent).toBe(false);
  });

  it('reports progress that ascends to 1', () => {
    const heard: number[] = [];
    analyse([new Float32Array(second)], second, recipe, (fraction) => heard.push(fraction));
    expect(heard).toEqual(heard.toSorted((a, b) => a - b));
    expect(heard.at(-1)).toBe(1);
  });
});

it('analyses three minutes of stereo in at most 10 seconds of processor time', { timeout: 300_000 }, () => {
  // Louder and softer over 5 seconds, so that no two repetitions are alike.
  const [song] = songs;
  const channel = Float32Array.from(
    { length: 180 * second },
    (_, i) => song!.audio[i % song!.audio.length]! * (0.6 + 0.4 * Math.sin(i / 38000)),
  );
  const seconds = processorSeconds(() => analyse([channel, channel], second, recipe, ignore));
  console.log(`Analysis of a three-minute song: ${seconds.toFixed(1)} s of processor time.`);
  expect(seconds).toBeLessThanOrEqual(10);
});

describe('the WAV encoder', () => {
  it('writes a header and interleaved, clipped samples', async () => {
    const wav = encodeWav([Float32Array.of(0, 0.5, 2), Float32Array.of(1, -1, -2)], 44100);
    const view = new DataView(await wav.arrayBuffer());
    const text = (offset: number): string =>
      String.fromCharCode(...[0, 1, 2, 3].map((i) => view.getUint8(offset + i)));
    expect([text(0), text(8), text(12), text(36)]).toEqual(['RIFF', 'WAVE', 'fmt ', 'data']);
    expect(view.getUint32(4, true)).toBe(view.byteLength - 8);
    expect([view.getUint16(20, true), view.getUint16(22, true), view.getUint16(34, true)]).toEqual([
      1, 2, 16,
    ]);
    expect([view.getUint32(24, true), view.getUint32(28, true), view.getUint16(32, true)]).toEqual([
      44100, 176400, 4,
    ]);
    expect(view.getUint32(40, true)).toBe(12);
    const samples = Array.from({ length: 6 }, (_, i) => view.getInt16(44 + 2 * i, true));
    expect(samples).toEqual([0, 32767, 16384, -32767, 32767, -32767]);
  });
});
