import { describe, expect, it } from 'vitest';
import {
  byteSize,
  bytesOf,
  clockTime,
  duration,
  rate,
  fileSlug,
  slug,
  toStep,
} from '../../../../web/ui/store/format';

describe('formatted numbers', () => {
  it('cuts seconds to tenths instead of rounding them', () => {
    expect(clockTime(16.79)).toBe('0:16.7');
    expect(clockTime(59.99)).toBe('0:59.9');
    expect(clockTime(125.5, false)).toBe('2:05');
    expect(clockTime(-1)).toBe('0:00.0');
  });

  it('does not lose a tenth to binary fractions', () => {
    expect(clockTime(0.3)).toBe('0:00.3');
    expect(clockTime(69 / 30)).toBe('0:02.3');
  });

  it('says of a length what the clock says, with tenths where it is short', () => {
    expect(duration(34.96)).toBe('0:34');
    expect(duration(7.5)).toBe('0:07.5');
    expect(duration(0.3)).toBe('0:00.3');
    expect(duration(125.5)).toBe('2:05');
  });

  it('writes bytes', () => {
    expect(bytesOf(24_600_000, 38_400_000)).toBe('24.6 of 38.4 MB');
    expect(bytesOf(1_250_000, 0)).toBe('1.3 MB');
    expect(byteSize(912_000)).toBe('912 KB');
    expect(byteSize(1_600_000)).toBe('1.6 MB');
    expect(byteSize(3)).toBe('1 KB');
  });

  it('writes rates', () => {
    expect(rate(120.0048)).toBe('120');
    expect(rate(29.97003)).toBe('29.97');
  });

  it('rounds to fader steps without floating-point remainders', () => {
    expect(toStep(0.151, 0.05, -1)).toBe(0.15);
    expect(toStep(-0.999, 0.05, -1)).toBe(-1);
    expect(toStep(0.6000000001, 0.05, -1)).toBe(0.6);
  });

  it('makes file names that every system takes', () => {
    expect(fileSlug('Descarga en Ré.mp3', 'song')).toBe('descarga-en-re');
    expect(fileSlug('leader_0412.bvh', 'leader')).toBe('leader-0412');
    expect(fileSlug('../..\\evil:name?.wav', 'song')).toBe('evil-name');
    expect(fileSlug('歌.mp3', 'song')).toBe('song');
    expect(fileSlug(`${'a'.repeat(300)}.mp3`, 'song')).toHaveLength(40);
    expect(slug('v1.1', 'take')).toBe('v1-1');
  });
});
