import { beforeEach, describe, expect, it } from 'vitest';
import type { QualityRequest, Report } from '../../../../web/quality/client';
import { measure } from '../../../../web/quality/measure';
import { createQuality } from '../../../../web/ui/quality/quality';
import { marksInOne, marksOf, worstRow } from '../../../../web/ui/quality/quality-marks';
import { laneTexts, momentCard, momentLabel } from '../../../../web/ui/quality/quality-text';
import * as change from '../../support/actions';
import { madeStander } from '../../support/made-stander';
import { small } from '../../support/small-manifest';
import { madeSettings, leader, song } from '../../support/made-state';

const stander = (sway = 0.05) =>
  madeStander({ frames: 90, path: (frame) => [sway * Math.sin(frame / 4.8), 0] });

describe('measuring', () => {
  let store: change.Store;
  let calls: { question: QualityRequest; signal: AbortSignal; answer: (report: Report) => void }[];
  const react = (motion = stander()): void => {
    const state = store.getState();
    const inputs = { leader: state.leader!, song: state.song, shift: state.shift, settings: madeSettings };
    change.apply(store, change.reactionAdded({ motion, latents: null, inputs, label: null, seconds: 1 }));
  };
  /** What promises do comes before the next task. */
  const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

  beforeEach(() => {
    calls = [];
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    createQuality(
      store,
      (question, signal) =>
        new Promise((answer, fail) => {
          calls.push({ question, signal, answer });
          signal.addEventListener('abort', () => {
            fail(signal.reason as Error);
          });
        }),
    );
    change.apply(store, change.leaderLoaded(leader(90)));
  });

  it('starts with a reaction, from the drawn reactor, the beats in frames and the blocks of the model', () => {
    expect(calls).toHaveLength(0);
    change.apply(store, change.songLoaded(song(3)));
    react();
    expect(calls).toHaveLength(1);
    const { duet, rules } = calls[0]!.question;
    expect(duet).toMatchObject({ fps: 30, frames: 90, beats: [0, 15, 30, 45, 60, 75], block: 24 });
    expect(duet.reactor).not.toEqual(store.getState().reaction!.motion.positions);
    expect(rules).toBe(small.quality);
  });

  it('aborts for a newer dance, and starts again when foot lock or song change', async () => {
    react();
    change.apply(store, change.footLockSet(false));
    change.apply(store, change.songLoaded(song(3)));
    expect(calls.map(({ signal }) => signal.aborted)).toEqual([true, true, false]);
    const { question, answer } = calls[2]!;
    expect(question.duet.reactor).toBe(store.getState().reaction!.motion.positions);
    const report = measure(question.duet, question.rules);
    answer(report);
    await settled();
    expect(store.getState().quality).toEqual({ reactor: store.getState().reaction!.motion, report });
    expect(store.getState().notices).toEqual([]);
  });

  it('keeps the numbers until new ones are there, but not for another leader', async () => {
    react();
    calls[0]!.answer(measure(calls[0]!.question.duet, calls[0]!.question.rules));
    await settled();
    const { quality } = store.getState();
    expect(quality).not.toBeNull();
    react(stander(0.1));
    expect(store.getState().quality).toBe(quality);
    change.apply(store, change.leaderLoaded(leader(60)));
    expect(store.getState().quality).toBeNull();
  });
});

describe('what is shown', () => {
  const { positions, fps, frames } = madeStander({ frames: 900, path: (t) => [0.3 * Math.sin(t / 20), 0] });
  const far = positions.map((value, index) => (index % 3 === 2 ? value + 1 : value));
  const report = measure(
    { fps, frames, leader: far, reactor: positions, beats: [], block: 240 },
    small.quality,
  );

  it('ranks the worst moments of all measures, a few in all', () => {
    const marks = marksOf(report);
    expect(marks.map(({ rank }) => rank)).toEqual(marks.map((_, index) => index + 1));
    expect(marks.length).toBeGreaterThan(0);
    expect(marks.length).toBeLessThanOrEqual(5);
    const severities = marks.map(({ moment }) => moment.severity);
    expect(severities).toEqual([...severities].sort((a, b) => b - a));
  });

  it('leaves marks out of the one lane that would overlap a worse mark', () => {
    const at = (frame: number) => ({ kind: 'seam' as const, frame, value: 3, severity: 1.5 });
    const marks = [100, 110, 300, 320, 600].map((frame, index) => ({
      part: 'seams' as const,
      rank: index + 1,
      moment: at(frame),
    }));
    expect(marksInOne(marks, 30).map(({ rank, moment }) => [rank, moment.frame])).toEqual([
      [1, 100],
      [2, 300],
      [3, 600],
    ]);
  });

  it('takes the worst of several rows, and NaN where all are NaN', () => {
    const rows = [Float32Array.of(NaN, 0.5, 2, NaN), Float32Array.of(1, 0.25, NaN, NaN)];
    expect([...worstRow(rows)]).toEqual([1, 0.5, 2, NaN]);
  });

  it('gives texts with the scores of recorded dancers', () => {
    const reference = {
      model: 'small',
      skateShare: 0.33,
      contactShare: 0.48,
      slideSpeed: null,
      overlapShare: null,
      music: 0.15,
      leader: 0.32,
    };
    const words = laneTexts(report, 8, reference);
    expect(words.feet.value).toMatch(/^\d+ %$/);
    expect(words.feet.sentence).toContain('(recorded dancers: 33 %)');
    expect(words.feet.sentence).toMatch(
      /of the dance \(recorded dancers: 48 %\) and move at \d\.\d\d m\/s there\.$/,
    );
    expect(words.closeness).toEqual({
      value: '1.00 m',
      sentence: 'At their closest the hips of the two are 1.00 m apart. The bodies never overlap.',
    });
    expect(words.beats.value).toMatch(/^– \d\.\d\d$/);
    expect(words.beats.sentence).toContain('No beats of the music');
    expect(words.seams.sentence).toContain('blocks of 8 s');
    const slide = { kind: 'slide' as const, frame: 753, value: 0.714, severity: 2 };
    expect(momentLabel(slide, 30)).toBe('Foot slide, 0.71 m/s at 0:25.1');
  });

  it.each([
    ['slide', 0.714, 'Foot slide', /slides at 0\.71 m\/s\. Up to 0\.20 m\/s counts as standing/],
    ['overlap', 0.041, 'Bodies overlap', /overlap by 4\.1 cm\. Up to 1\.0 cm counts as a touch/],
    ['leader', 0.05, 'Off the leader’s beat', /beats of the leader: 0\.05 .* would be \d\.\d\d\./],
    ['seam', 3.2, 'Rough seam', /changes 3\.20 times as abruptly/],
  ] as const)('explains a mark: what it is, how bad and when (%s)', (kind, value, title, text) => {
    const explained = momentCard({ kind, value, frame: 753, severity: 2 }, 30, report, small.quality);
    expect(explained).toEqual({ title, aside: '0:25.1', text: expect.stringMatching(text) as string });
  });
});
