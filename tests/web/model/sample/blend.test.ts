import { describe, expect, it } from 'vitest';
import {
  blend,
  type Branches,
  coarseAlone,
  layerGains,
  neededBranches,
} from '../../../../web/model/sample/blend';

const latent = { streams: ['upper', 'lower', 'placement'], layers: ['coarse', 'fine'], channels: 6 };
const values = (seed: number): Float32Array =>
  Float32Array.from({ length: 2 * 2 * 6 }, (_, i) => Math.sin(seed + i));
const branches: Branches = {
  conditional: values(1),
  silent: values(2),
  unconditional: values(3),
  mean: values(4).subarray(0, 2 * 6),
};
const PLAIN = { guidance: new Float32Array(6), musicGuidance: 0, variety: 1 };

describe('guidance after sampling', () => {
  it('is Equation 9 in the coarse layer of each stream, with variety, and the term of the song in all layers', () => {
    const guidance = Float32Array.from([0.5, 9, -1, 9, 2, 9]); // fine weights act when latents are decoded
    const out = blend(branches, { guidance, musicGuidance: 1.5, variety: 0.5 }, latent);
    out.forEach((value, i) => {
      const [layer, stream] = [Math.floor(i / 6) % 2, Math.floor((i % 6) / 2)];
      const [cond, silent, uncond] = [values(1)[i]!, values(2)[i]!, values(3)[i]!];
      const s = layer === 0 ? guidance[stream * 2]! : 0;
      const mean = values(4)[Math.floor(i / 12) * 6 + (i % 6)]!;
      const varied = layer === 0 ? mean + 0.5 * (cond - mean) : cond;
      expect(value).toBeCloseTo(varied + 1.5 * (cond - silent) + s * (cond - uncond), 5);
    });
  });

  it('leaves the conditional branch without weights, and asks for no other', () => {
    expect(neededBranches(PLAIN, latent)).toEqual({ silent: false, unconditional: false, mean: false });
    const alone = { conditional: values(1), silent: null, unconditional: null, mean: null };
    expect(blend(alone, PLAIN, latent)).toEqual(values(1));
    expect(blend(branches, PLAIN, latent)).toEqual(values(1));
  });

  it('asks for the branches that a weight needs', () => {
    const fine = { ...PLAIN, guidance: Float32Array.from([0, 1, 0, 1, 0, 1]) };
    expect(neededBranches(fine, latent).unconditional).toBe(false);
    const legs = { guidance: Float32Array.from([0, 0, 0.5, 0, 0, 0]), musicGuidance: 3, variety: 2 };
    expect(neededBranches(legs, latent)).toEqual({ silent: true, unconditional: true, mean: true });
  });

  it('multiplies the fine layer by 1 + s, down to the coarse layer alone', () => {
    expect([...layerGains(Float32Array.from([2, 0.5, 2, -1, 2, 0]), latent)]).toEqual([1, 1.5, 1, 0, 1, 1]);
    expect([...coarseAlone(latent)]).toEqual([1, 0, 1, 0, 1, 0]);
  });
});
