import { describe, expect, it } from 'vitest';
import {
  checkSource,
  type GenerateRequest,
  prepareInput,
  sameDecoded,
} from '../../../../web/model/sample/inputs';
import { stepCounts } from '../../../../web/motion/beats/step-timing';
import type { MotionClip } from '../../../../web/motion/skeleton/clip';
import { solve } from '../../../../web/motion/fit/ik';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { bodyHeight } from '../../../../web/motion/skeleton/scale';
import { J } from '../../../../web/motion/skeleton/skeleton';
import { madeDancer } from '../../support/made-dancer';
import { small } from '../../support/small-manifest';

const WIDTH = small.audio.features;

/** Largest difference of two lists of numbers. */
const worst = (a: Float32Array, b: Float32Array): number =>
  a.reduce((most, value, i) => Math.max(most, Math.abs(value - b[i]!)), 0);

const loaded = (leader: MotionClip): Pick<GenerateRequest, 'leader' | 'fitted'> => ({
  leader,
  fitted: solve(leader),
});

/** A standing leader of some frames and a song whose features in frame f are all f + 1. */
function request(frames: number, song: { frames: number; start?: number } | null): GenerateRequest {
  const positions = new Float32Array(frames * small.skeleton.joints.length * 3);
  for (let i = 0; i < positions.length; i += 3) positions[i + 1] = ((i / 3) % 22) * 0.08;
  return {
    ...loaded({ fps: small.fps, frames, positions }),
    music: song && {
      ...song,
      features: Float32Array.from({ length: song.frames * WIDTH }, (_, i) => Math.floor(i / WIDTH) + 1),
    },
    guidance: new Float32Array(small.latent.streams.length * small.latent.layers.length),
    musicGuidance: 0,
    variety: 1,
    seed: 1,
  };
}

/** The song's frame, from 1, that is heard in each frame of the clip; 0 in silence. */
function heard(what: GenerateRequest): number[] {
  const { music, musicValid } = prepareInput(what, small).condition;
  return Array.from(musicValid, (valid, frame) => {
    const columns = new Set(music.subarray(frame * WIDTH, (frame + 1) * WIDTH));
    expect(columns.size).toBe(1);
    const [value = NaN] = columns;
    expect(value === 0).toBe(valid === 0);
    return value;
  });
}

describe('the song in the model', () => {
  it('begins with the clip when it is not shifted', () => {
    expect(heard(request(8, { frames: 12 }))).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
    expect(heard(request(8, { frames: 12, start: 0 }))).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
    expect(heard(request(8, null))).toEqual([0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it('begins later, after silence, when it is shifted forwards', () => {
    expect(heard(request(8, { frames: 12, start: 3 }))).toEqual([0, 0, 0, 1, 2, 3, 4, 5]);
    expect(heard(request(8, { frames: 2, start: 3 }))).toEqual([0, 0, 0, 1, 2, 0, 0, 0]);
    expect(heard(request(8, { frames: 2, start: 30 }))).toEqual([0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it('loses its beginning when it is shifted backwards, and silence follows', () => {
    expect(heard(request(8, { frames: 6, start: -2 }))).toEqual([3, 4, 5, 6, 0, 0, 0, 0]);
    expect(heard(request(8, { frames: 6, start: -20 }))).toEqual([0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it('has its beats where it begins, and the role of the dancer to make', () => {
    const what = request(60, { frames: 60, start: 7 });
    const beats = [0.2, 0.7, 1.2];
    const { steps, condition } = prepareInput({ ...what, music: { ...what.music!, beats } }, small);
    const shifted = beats.map((beat) => 7 + beat * 30);
    expect([...steps]).toEqual([...stepCounts(shifted, steps.length, 30)]);
    expect(condition.role).toBe(0);
    expect(prepareInput({ ...what, role: 'leader' }, small).condition.role).toBe(1);
  });

  it('moves by whole frames only', () => {
    expect(() => {
      checkSource(request(8, { frames: 6, start: 0.5 }), small);
    }).toThrow(/starts at frame 0.5/);
  });
});

describe('the leader in the model', () => {
  it('stands still after the end, up to a whole latent frame', () => {
    const what = request(7, null);
    const width = what.leader.positions.length / 7;
    const positions = what.leader.positions.map((value, i) => value + Math.floor(i / width));
    const input = prepareInput({ ...what, ...loaded({ ...what.leader, positions }) }, small);
    for (const leader of [input.condition.leader, input.leader]) {
      expect(leader).toHaveLength(8 * width);
      expect(leader.subarray(7 * width)).toEqual(leader.subarray(6 * width, 7 * width));
      expect(leader[6 * width]).not.toBe(leader[5 * width]);
    }
  });

  it('has the body of the training in the condition, and their own beside what is decoded', () => {
    const leader = madeDancer({ frames: 60 });
    // Shoulders as narrow as some rigs have them.
    const offsets = leader.offsets.map(
      (value, i) => value * (Math.floor(i / 3) === J.left_shoulder ? 0.5 : 1),
    );
    const narrow = {
      ...leader,
      offsets,
      positions: forwardKinematics(offsets, leader.root, leader.rotations),
    };
    const body = Array.from({ length: 22 }, (_, joint) => [
      ...leader.offsets.subarray(3 * joint, 3 * joint + 3),
    ]);
    const skeleton = {
      ...small.skeleton,
      reference_height: bodyHeight(leader),
      training_bodies: { leader: body, reactor: body.map((offset) => offset.map((value) => value * 0.9)) },
    };
    const input = prepareInput({ leader: narrow, fitted: narrow, music: null }, { ...small, skeleton });
    expect(worst(input.condition.leader, leader.positions)).toBeLessThan(1e-5);
    expect(worst(input.leader, narrow.positions)).toBeLessThan(1e-5);
    const asLeader = prepareInput(
      { leader: narrow, fitted: narrow, music: null, role: 'leader' },
      { ...small, skeleton },
    );
    expect(worst(asLeader.condition.leader, leader.positions)).toBeGreaterThan(0.05);
    expect(bodyHeight({ ...leader, positions: asLeader.condition.leader })).toBeCloseTo(
      0.9 * bodyHeight(leader),
      4,
    );
  });
});

describe('two requests', () => {
  const one = request(8, { frames: 12, start: 3 });

  it('are for the same joints where only height and hands differ', () => {
    const other = { ...one, guidance: one.guidance.slice(), height: 1.8, holdHands: false };
    expect(sameDecoded(one, other)).toBe(true);
  });

  it.each<[string, Partial<GenerateRequest>]>([
    ['leader', { leader: { ...one.leader } }],
    ['leader on a skeleton', { fitted: { ...one.fitted } }],
    ['song', { music: null }],
    ['features', { music: { ...one.music!, features: one.music!.features.slice() } }],
    ['beats of the song', { music: { ...one.music!, beats: [0.5] } }],
    ['start of the song', { music: { ...one.music!, start: 4 } }],
    ['role', { role: 'leader' }],
    ['seed', { seed: 2 }],
    ['weight of the music', { musicGuidance: 1 }],
    ['variety', { variety: 0.5 }],
    ['guidance', { guidance: one.guidance.map((_, i) => (i === 5 ? 1 : 0)) }],
  ])('are for another dance with another %s', (_, changes) => {
    expect(sameDecoded(one, { ...one, ...changes })).toBe(false);
  });
});
