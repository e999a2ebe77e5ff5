import { afterEach, describe, expect, it, vi } from 'vitest';
import { createBodyLibrary, roundedOffsets } from '../../../web/view/body/library';
import { BUILDS } from '../../../web/view/body/part';
import { person } from './skeletons';

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
    expect((await first).indices.length).toBeGreaterThan(30_000);
    expect(warn).toHaveBeenCalledTimes(1);
    expect(library.request(person(), BUILDS.reactor)).not.toBe(first);
    expect(library.request(person(1.1), BUILDS.leader)).not.toBe(first);
    library.dispose();
  });
});
