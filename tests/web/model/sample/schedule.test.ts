import { parseManifest } from '../../../../web/model/parse-manifest';
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { ddim } from '../../../../web/model/sample/schedule';
import { small } from '../../support/small-manifest';

const read = (path: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../fixtures/${path}`, import.meta.url), 'utf8'));

describe('ddim', () => {
  const { diffusion } = small;

  it('goes in even steps from the last train step to the last time, and from there to the clean latents', () => {
    for (const steps of [1, 2, 3, 7, 10, 50]) {
      const schedule = ddim({ ...diffusion, steps });
      expect(schedule).toHaveLength(steps);
      expect(schedule[0]?.time).toBe(0.999);
      expect(schedule.at(-1)).toMatchObject({ a: 0, b: 1 });
      const times = schedule.map(({ time }) => time);
      expect(times).toEqual([...times].sort((a, b) => b - a));
      expect(new Set(times).size).toBe(steps);
    }
    expect(ddim({ ...diffusion, steps: 3 }).map(({ time }) => Math.round(time * 1000))).toEqual([
      999, 624, 249,
    ]);
    expect(ddim({ ...diffusion, steps: 6 }).map(({ time }) => Math.round(time * 1000))).toEqual([
      999, 849, 699, 549, 399, 249,
    ]);
  });

  it('keeps a noised sample on its path: x_t = sqrt(ab) x0 + sqrt(1 - ab) e goes to the same e at the next step', () => {
    const [x0, e] = [0.7, -1.3];
    const schedule = ddim({ ...diffusion, steps: 10 });
    const alpha = (k: number): number =>
      k < 10 ? (diffusion.alphas_cumprod[Math.round((schedule[k]?.time ?? NaN) * 1000)] ?? NaN) : 1;
    schedule.forEach(({ a, b }, k) => {
      const x = Math.sqrt(alpha(k)) * x0 + Math.sqrt(1 - alpha(k)) * e;
      const expected = Math.sqrt(alpha(k + 1)) * x0 + Math.sqrt(1 - alpha(k + 1)) * e;
      expect(a * x + b * x0).toBeCloseTo(expected, 12);
    });
  });

  it('has the same coefficients as Python on the exported schedule', () => {
    const manifest = parseManifest(read('tiny-model/manifest.json'));
    const { schedules } = read('sampling.json') as {
      schedules: { steps: number; last_time: number; plan: number[][] }[];
    };
    expect(schedules.length).toBeGreaterThan(5);
    for (const { steps, last_time, plan } of schedules) {
      ddim({ ...manifest.diffusion, last_time, steps }).forEach(({ time, a, b }, k) => {
        [time, a, b].forEach((value, i) => expect(value).toBeCloseTo(plan[k]?.[i] ?? NaN, 7));
      });
    }
  });
});
