import { describe, expect, it } from 'vitest';
import {
  checkSource,
  type GenerateRequest,
  prepareInput,
  sameDecoded,
} from '../../../../web/model/sample/inputs';
import { small } from '../../support/small-manifest';

const WIDTH = small.audio.features;

/** A standing leader of some frames and a song whose features in frame f are all f + 1. */
function request(frames: number, song: { frames: number; start?: number } | null): GenerateRequest {
  const positions = new Float32Array(frames * small.skeleton.joints.length * 3);
  for (let i = 0; i < positions.length; i += 3) positions[i + 1] = ((i / 3) % 22) * 0.08;
  return {
    leader: { fps: small.fps, frames, positions },
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
    what.leader.positions.forEach((value, i) => (what.leader.positions[i] = value + Math.floor(i / width)));
    const { leader } = prepareInput(what, small).condition;
    expect(leader).toHaveLength(8 * width);
    expect(leader.subarray(7 * width)).toEqual(leader.subarray(6 * width, 7 * width));
    expect(leader[6 * width]).not.toBe(leader[5 * width]);
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
    ['song', { music: null }],
    ['features', { music: { ...one.music!, features: one.music!.features.slice() } }],
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
