import { describe, expect, it } from 'vitest';
import { blend, type Branches, coarseAlone, layerGains, neededBranches } from '../../../../web/model/sample/blend';

const latent = { streams: ['upper', 'lower', 'placement'], layers: ['coarse', 'fine'], channels: 6 };
const values = (seed: number): Float32Array =>
  Float32Array.from({ length: 2 * 2 * 6 }, (_, i) => Math.sin(seed + i));
const branches: Branches = { conditional: values(1), silent: values(2), unconditional: values(3) };

describe('guidance after sampling', () => {
  it('is Equation 9 in the coarse layer of each stream, with the term of the song in all layers', () => {
    const guidance = Float32Array.from([0.5, 9, -1, 9, 2, 9]); // fine weights act when latents are decoded
    const out = blend(branches, { guidance, musicGuidance: 1.5 }, latent);
    out.forEach((value, i) => {
      const [layer, stream] = [Math.floor(i / 6) % 2, Math.floor((i % 6) / 2)];
      const [cond, silent, uncond] = [values(1)[i]!, values(2)[i]!, values(3)[i]!];
      const s = layer === 0 ? guidance[stream * 2]! : 0;
      expect(value).toBeCloseTo(cond + 1.5 * (cond - silent) + s * (cond - uncond), 5);
    });
  });

  it('leaves the conditional branch without weights, and asks for no other', () => {
    const none = { guidance: new Float32Array(6), musicGuidance: 0 };
    expect(neededBranches(none, latent)).toEqual({ silent: false, unconditional: false });
    expect(blend({ ...branches, silent: null, unconditional: null }, none, latent)).toEqual(values(1));
  });

  it('asks for the branches that a weight needs', () => {
    const fine = { guidance: Float32Array.from([0, 1, 0, 1, 0, 1]), musicGuidance: 0 };
    expect(neededBranches(fine, latent).unconditional).toBe(false);
    const legs = { guidance: Float32Array.from([0, 0, 0.5, 0, 0, 0]), musicGuidance: 3 };
    expect(neededBranches(legs, latent)).toEqual({ silent: true, unconditional: true });
  });

  it('multiplies the fine layer by 1 + s, down to the coarse layer alone', () => {
    expect([...layerGains(Float32Array.from([2, 0.5, 2, -1, 2, 0]), latent)]).toEqual([1, 1.5, 1, 0, 1, 1]);
    expect([...coarseAlone(latent)]).toEqual([1, 0, 1, 0, 1, 0]);
  });
});
