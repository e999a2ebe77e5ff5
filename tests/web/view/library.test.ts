import { afterEach, describe, expect, it, vi } from 'vitest';
import { createBodyLibrary, roundedOffsets } from '../../../web/view/body/library';
import { BUILDS } from '../../../web/view/body/part';
import { person } from './skeletons';
import { topology } from './topology';

afterEach(() => vi.restoreAllMocks());

describe('the body library', () => {
  it('makes bodies without a worker too, once for skeletons that differ by millimetres', async () => {
    // Node has no Worker: what a page does whose worker could not be started.
    const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    const library = createBodyLibrary();
    const first = library.request(person(), BUILDS.leader);
    const again = library.request(
      roundedOffsets(person()).map((value) => value + 0.003),
      BUILDS.leader,
    );
    expect(again).toBe(first);
    const { indices, light, positions } = await first;
    expect(indices.length).toBeGreaterThan(30_000);
    expect(light.length).toBeLessThan(0.45 * indices.length);
    expect(Math.max(...light)).toBeLessThan(positions.length / 3);
    // Closed as the full surface, and of the same size.
    const [thin, full] = [light, indices].map((triangles) => topology({ positions, indices: triangles }));
    expect(thin).toMatchObject({ holes: 0, openEdges: 0 });
    expect(thin!.volume / full!.volume).toBeCloseTo(1, 1);
    expect(warn).toHaveBeenCalledTimes(1);
    expect(library.request(person(), BUILDS.reactor)).not.toBe(first);
    expect(library.request(person(1.1), BUILDS.leader)).not.toBe(first);
    library.dispose();
  });
});
