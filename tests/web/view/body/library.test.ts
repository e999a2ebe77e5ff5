import { afterEach, describe, expect, it, vi } from 'vitest';
import { createBodyLibrary } from '../../../../web/view/body/library';
import { BUILDS } from '../../../../web/view/body/part';
import { person } from '../../support/skeletons';
import { topology } from '../../support/topology';

/** Number of vertices computed with a vertex cache of 16. */
function computed(triangles: Uint32Array): number {
  const last: number[] = [];
  return triangles.filter((vertex) => {
    if (last.includes(vertex)) return false;
    last.push(vertex);
    if (last.length > 16) last.shift();
    return true;
  }).length;
}

afterEach(() => vi.restoreAllMocks());

describe('the body library', () => {
  it('makes bodies without a worker too, once for skeletons that differ by millimetres', async () => {
    // Node has no Worker, as on a page whose worker could not be started.
    const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    const library = createBodyLibrary();
    const first = library.request(person(), BUILDS.leader);
    const again = library.request(
      person().map((value, i) => value + (i % 2 === 0 ? 0.008 : -0.008)),
      BUILDS.leader,
    );
    expect(again).toBe(first);
    const { indices, near, light, positions, offsets } = await first;
    expect(offsets).toEqual(Float32Array.from(person()));
    expect(indices.length).toBeGreaterThan(30_000);
    const full = topology({ positions, indices });
    for (const [triangles, share] of [
      [near, 0.5],
      [light, 0.25],
    ] as const) {
      expect(triangles.length / indices.length).toBeCloseTo(share, 1);
      // Closed as the full surface, and of the same size.
      const simplified = topology({ positions, indices: triangles });
      expect(simplified).toMatchObject({ holes: 0, openEdges: 0 });
      expect(simplified.volume / full.volume).toBeCloseTo(1, 1);
      expect(computed(triangles)).toBeLessThan(0.75 * (triangles.length / 3));
    }
    expect(warn).toHaveBeenCalledTimes(1);
    expect(library.request(person(), BUILDS.reactor)).not.toBe(first);
    expect(library.request(person(1.1), BUILDS.leader)).not.toBe(first);
    const oneBone = person();
    oneBone[22] = oneBone[22]! + 0.012;
    expect(library.request(oneBone, BUILDS.leader)).not.toBe(first);
    library.dispose();
  });

  it('tries again to make a body that could not be made', async () => {
    vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    const library = createBodyLibrary();
    // Too large for the memory.
    const huge = person(1e5);
    const first = library.request(huge, BUILDS.leader);
    expect(library.request(huge, BUILDS.leader)).toBe(first);
    await expect(first).rejects.toThrow();
    const again = library.request(huge, BUILDS.leader);
    expect(again).not.toBe(first);
    await expect(again).rejects.toThrow();
    library.dispose();
  });
});
