/** The measures of the page against training/evaluation/metrics, on the same duet. */
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { visibleSlide } from '../../../web/quality/contact';
import { measure } from '../../../web/quality/measure';
import { severity, worstMoments } from '../../../web/quality/moments';
import { overlapDepth } from '../../../web/quality/penetration';
import type { Duet, Rules } from '../../../web/quality/rules';
import { boundaries, velocityChange } from '../../../web/quality/seams';
import { beatScores } from '../../../web/motion/beats/beat-match';
import { motionBeats } from '../../../web/motion/beats/motion-beats';
import { footContacts, RELEASE_SPEED } from '../../../web/motion/contact/foot-contacts';
import { readNpz } from '../../../web/model/load/npz';
import { madeStander } from '../support/made-stander';

const folder = new URL('../../fixtures/', import.meta.url);
const golden = JSON.parse(readFileSync(new URL('quality.json', folder), 'utf8')) as {
  fps: number;
  block: number;
  music_beats: number[];
  rules: Rules;
  feet: Record<string, number>;
  closeness: Record<string, number>;
  beats: Record<string, number>;
  seams: Record<string, number>;
  seam_frames: number[];
  depth: number[];
  velocity_change: number[];
};
const motions = readNpz(new Uint8Array(readFileSync(new URL('quality.npz', folder))));
const positions = (name: string): Float32Array => Float32Array.from(motions.get(name)!.data);

const duet: Duet = {
  fps: golden.fps,
  frames: motions.get('leader')!.shape[0]!,
  leader: positions('leader'),
  reactor: positions('reactor'),
  beats: golden.music_beats,
  block: golden.block,
};
const report = measure(duet, golden.rules);
const reactor = { ...duet, positions: duet.reactor };

/** Both say the same number, to a billionth of it. */
function agree(ours: number, theirs: number | undefined): void {
  expect(theirs).toBeTypeOf('number');
  expect(Math.abs(ours - theirs!)).toBeLessThanOrEqual(1e-9 * Math.max(1e-3, Math.abs(theirs!)));
}

describe('the numbers of the whole dance are those of Python', () => {
  test('feet', () => {
    const { skateShare, slideSpeed, contactShare } = report.feet.whole;
    agree(skateShare, golden.feet.skate_share);
    agree(slideSpeed, golden.feet.slide_speed);
    agree(contactShare, golden.feet.contact_share);
  });

  test('closeness', () => {
    const { overlapShare, deepest, closest } = report.closeness.whole;
    agree(overlapShare, golden.closeness.ipr_capsules);
    agree(deepest, golden.closeness.deepest);
    agree(closest, golden.closeness.closest);
  });

  test('beats', () => {
    const { music, leader } = report.beats.whole;
    agree(music.value, golden.beats.value);
    agree(music.chance, golden.beats.chance);
    agree(leader.value, golden.beats.forward);
    agree(leader.chance, golden.beats.forward_chance);
  });

  test('seams', () => {
    const { seams, ratio } = report.seams.whole;
    expect(boundaries(duet.frames, duet.block)).toEqual(golden.seam_frames);
    expect(seams).toBe(golden.seam_frames.length);
    agree(ratio, golden.seams.ratio);
  });
});

describe('so are the curves', () => {
  test('overlap', () => {
    overlapDepth(duet, golden.rules.penetration).forEach((depth, frame) => agree(depth, golden.depth[frame]));
  });

  test('change of velocity', () => {
    const change = velocityChange(duet.reactor, duet.frames);
    expect([change[0], change.at(-1)]).toEqual([NaN, NaN]);
    change.slice(1, -1).forEach((value, index) => agree(value, golden.velocity_change[index]));
  });
});

describe('the worst moments are at the made faults', () => {
  const seconds = (part: keyof typeof report): number[] =>
    report[part].worst.map(({ frame }) => frame / golden.fps);

  test('a foot slides at half a metre per second, and all worst moments are slower than a step', () => {
    const seen = visibleSlide(footContacts(reactor, golden.rules.contact));
    expect(seen[315]).toBeCloseTo(0.5, 1);
    expect(report.feet.worst).toHaveLength(3);
    for (const { value } of report.feet.worst) {
      expect(value).toBeGreaterThan(golden.rules.contact.slide_speed);
      expect(value).toBeLessThan(RELEASE_SPEED);
    }
  });

  test('feet are in contact as low and as slow as the rule says', () => {
    const count = (changes: object): number =>
      footContacts(reactor, { ...golden.rules.contact, ...changes }).inContact.reduce((a, b) => a + b, 0);
    expect(count({ height: 0.02 })).toBeLessThan(count({}));
    expect(count({ vertical_speed: 0.05 })).toBeLessThan(count({}));
    expect(count({ percentile: 50 })).toBeGreaterThan(count({}));
  });

  test('the bodies run into each other around 12.3 s', () => {
    const [worst] = report.closeness.worst;
    expect(worst!.value).toBe(report.closeness.whole.deepest);
    expect(Math.abs(worst!.frame - 370)).toBeLessThan(40);
  });

  test('the second seam jumps, the first does not', () => {
    expect(seconds('seams')).toEqual([16]);
  });

  test('moments of one measure are a least distance apart', () => {
    for (const { worst } of [report.feet, report.closeness, report.beats, report.seams]) {
      const frames = worst.map(({ frame }) => frame).sort((a, b) => a - b);
      frames.slice(1).forEach((frame, index) => expect(frame - frames[index]!).toBeGreaterThan(29));
    }
  });
});

describe('what is drawn', () => {
  const severities = (part: keyof typeof report): number[] =>
    report[part].worst.map(({ severity }) => severity);

  test('severity is 0 at fine, 1 at the limit and 2 at bad, never below 0, whichever end is fine', () => {
    for (const [fine, limit, bad] of [
      [0, 1, 3],
      [4, 2, 0],
    ] as const) {
      const scale = { fine, limit, bad };
      expect([fine, limit, bad, 2 * bad - limit].map((value) => severity(value, scale))).toEqual([
        0, 1, 2, 3,
      ]);
      expect(severity(2 * fine - limit, scale)).toBe(0);
      expect(severity(NaN, scale)).toBeNaN();
    }
  });

  test('a slide four times over the limit, and an overlap five times over it, have severity 2', () => {
    const { slide_speed } = golden.rules.contact;
    const { deep } = golden.rules.penetration;
    expect(severities('feet').length * severities('closeness').length).toBeGreaterThan(0);
    severities('feet').forEach((severity, i) =>
      expect(severity).toBeCloseTo(1 + (report.feet.worst[i]!.value / slide_speed - 1) / 3, 5),
    );
    severities('closeness').forEach((severity, i) =>
      expect(severity).toBeCloseTo(1 + (report.closeness.worst[i]!.value / deep - 1) / 4, 5),
    );
  });

  test('dancers who are close without touching are no fault', () => {
    const [still, beside] = [0, 0.6].map(
      (z) => madeStander({ frames: 30, path: () => [0, z] }).positions,
    ) as [Float32Array, Float32Array];
    const close = measure({ ...duet, frames: 30, leader: still, reactor: beside, beats: [] }, golden.rules);
    expect(close.closeness.whole).toMatchObject({ overlapShare: 0, deepest: 0 });
    close.closeness.rows[0]!.forEach((value) => expect(value).toBeCloseTo(0.5, 5));
    expect(close.closeness.worst).toEqual([]);
  });

  test('a brush of the floor is no slide, a contact of a third of a second is', () => {
    const slid = (frames: number): number | undefined => {
      const inContact = new Uint8Array(30 * 4).map((_, i) =>
        Number(i % 4 === 0 && i / 4 >= 10 && i / 4 < 10 + frames),
      );
      return visibleSlide({ inContact, speed: new Float64Array(30 * 4).fill(0.4) })[12];
    };
    expect(slid(4)).toBeNaN();
    expect(slid(10)).toBeCloseTo(0.4, 6);
  });

  test('without a song there is no row of the music, and beats outside the dance do not count', () => {
    const silent = measure({ ...duet, beats: [] }, golden.rules).beats;
    expect(silent.rows).toEqual([report.beats.rows[1]]);
    expect(silent.whole.music.value).toBeNaN();
    const around = [-40, -5, ...duet.beats, duet.frames, duet.frames + 20];
    expect(measure({ ...duet, beats: around }, golden.rules).beats).toEqual(report.beats);
  });

  test('the row of a beat is its score with those around it, weighed by a Gaussian of a second and a half', () => {
    const { rows, whole } = report.beats;
    const { smoothing, tolerance } = golden.rules.beats;
    const beats = duet.beats.filter((beat) => beat >= 0 && beat < duet.frames);
    const scores = beatScores(beats, motionBeats(reactor, smoothing), tolerance);
    const { chance } = whole.music;
    for (let frame = 0; frame < duet.frames; frame += 7) {
      const weights = beats.map((beat) => Math.exp(-((frame - beat) ** 2) / 2 / (1.5 * golden.fps) ** 2));
      const sum = (values: number[]): number => values.reduce((a, b) => a + b, 0);
      const score = sum(weights.map((weight, i) => weight * scores[i]!)) / sum(weights);
      const expected = severity(score, { fine: 2 * chance, limit: chance / 2, bad: -chance / 2 });
      expect(Math.abs(rows[0]![frame]! - expected)).toBeLessThan(0.02);
    }
  });

  test('a single beat of the music judges nothing', () => {
    const { rows, worst } = measure({ ...duet, beats: [200] }, golden.rules).beats;
    expect(rows[0]!.every(Number.isNaN)).toBe(true);
    expect(worst.every(({ kind }) => kind !== 'music')).toBe(true);
  });

  test('seams are drawn around the seams alone', () => {
    const { clear } = golden.rules.seams;
    report.seams.rows[0]!.forEach((value, frame) => {
      const near = golden.seam_frames.some((seam) => frame >= seam - clear && frame < seam + clear);
      expect(Number.isNaN(value)).toBe(!near);
    });
  });

  test('of peaks within a thirtieth of a long dance the worst is a moment, of equal ones the first', () => {
    const momentsOf = (frames: number, peaks: Record<number, number>): number[] => {
      const row = new Float32Array(frames);
      for (const [frame, value] of Object.entries(peaks)) row[Number(frame)] = value;
      return worstMoments(row, 30, 'slide', () => 0).map(({ frame }) => frame);
    };
    expect(momentsOf(3000, { 1000: 2, 1090: 3, 2000: 1.5 })).toEqual([1090, 2000]);
    expect(momentsOf(600, { 100: 2, 190: 3 })).toEqual([190, 100]);
    expect(momentsOf(600, { 100: 2, 120: 2 })).toEqual([100]);
    expect(momentsOf(600, { 100: 1.1, 200: 1.4, 300: 1.2, 400: 1.3, 500: 0.9 })).toEqual([200, 400, 300]);
  });
});
