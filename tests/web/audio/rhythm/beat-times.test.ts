import { expect, it } from 'vitest';
import { beatFrames } from '../../../../web/audio/rhythm/beat-times';

it('stays on the beat where what is between the beats is louder for a while', () => {
  const [frames, period] = [1500, 10.6];
  const onset = new Float64Array(frames);
  for (let beat = 0; beat * period < frames - 1; beat++) {
    const offbeat = Math.round((beat + 0.5) * period);
    onset[Math.round(beat * period)]! += 1;
    if (offbeat > 500 && offbeat < 800) onset[offbeat]! += 1.35;
  }
  const mean = onset.reduce((sum, value) => sum + value, 0) / frames;
  const power = Math.sqrt(onset.reduce((sum, value) => sum + (value - mean) ** 2, 0) / frames);
  const beats = beatFrames(
    onset.map((value) => (value - mean) / power),
    new Float64Array(frames).fill(period),
  );
  const off = beats.map((frame) => Math.abs(frame / period - Math.round(frame / period)) * period);
  expect(Math.max(...off)).toBeLessThan(1.5);
});
