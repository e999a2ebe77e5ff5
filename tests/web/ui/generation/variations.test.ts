import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { VariationMaker } from '../../../../web/ui/generation/variations';
import { Generation } from '../../../../web/ui/generation/generation';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { ManualGenerator, result } from '../../support/manual-generator';
import { leader } from '../../support/made-state';

describe('three variations', () => {
  let store: change.Store;
  let model: ManualGenerator;
  let generation: Generation;
  let variations: VariationMaker;

  const pass = (): Promise<void> => vi.advanceTimersByTimeAsync(60).then(() => undefined);
  const answer = async (index: number): Promise<void> => {
    model.calls[index]?.answer(result());
    await pass();
  };
  const seeds = (): number[] => model.calls.map(({ request }) => request.seed);
  const there = (): boolean[] =>
    store.getState().variations?.list.map(({ reaction }) => reaction !== null) ?? [];

  beforeEach(async () => {
    vi.useFakeTimers();
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    model = new ManualGenerator();
    const load = (): Promise<typeof model.generator> => Promise.resolve(model.generator);
    generation = new Generation(store, load);
    variations = new VariationMaker(store, load, generation.generate);
    change.apply(store, change.leaderLoaded(leader(60)));
    await pass();
  });
  afterEach(() => {
    variations.dispose();
    generation.dispose();
    vi.useRealTimers();
  });

  it('are the one on the stage and two more, one after the other', async () => {
    await answer(0);
    variations.make();
    await pass();
    expect(seeds()).toEqual([7, 8]);
    expect(there()).toEqual([true, false, false]);
    model.calls[1]?.options.onProgress?.({ stage: 'step', done: 1, total: 2, fraction: 0.5 });
    expect(store.getState().variations?.list[1]?.fraction).toBe(0.5);
    await answer(1);
    expect(seeds()).toEqual([7, 8, 9]);
    await answer(2);
    expect(there()).toEqual([true, true, true]);
    expect(store.getState().variations?.making).toBe(false);
  });

  it('wait for the one that is just being made', async () => {
    variations.make();
    await pass();
    expect(seeds()).toEqual([7]);
    await answer(0);
    expect(seeds()).toEqual([7, 8]);
  });

  it('set their settings when they are picked, and nothing is made again', async () => {
    await answer(0);
    variations.make();
    await pass();
    await answer(1);
    variations.pick(8);
    await pass();
    const { reaction, settings, job } = store.getState();
    expect([reaction?.inputs.settings.seed, settings?.seed, job]).toEqual([8, 8, null]);
    // The third is still on its way.
    expect(seeds()).toEqual([7, 8, 9]);
    expect(model.calls[2]?.options.signal?.aborted).toBe(false);
  });

  it('stop when cancelled, keep what is made, and go on when requested again', async () => {
    await answer(0);
    variations.make();
    await pass();
    await answer(1);
    variations.cancel();
    await pass();
    expect(there()).toEqual([true, true, false]);
    expect(model.calls[2]?.options.signal?.aborted).toBe(true);
    variations.make();
    await pass();
    expect(seeds()).toEqual([7, 8, 9, 9]);
  });

  it('are dropped when other settings are chosen', async () => {
    await answer(0);
    variations.make();
    await pass();
    change.apply(store, change.guidanceSet('coarse', 1));
    await pass();
    expect(store.getState().variations).toBeNull();
    expect(model.calls[1]?.options.signal?.aborted).toBe(true);
    expect(seeds()).toEqual([7, 8, 7]);
  });

  it('are three others the next time', async () => {
    await answer(0);
    variations.make();
    await pass();
    await answer(1);
    await answer(2);
    vi.spyOn(Math, 'random').mockReturnValue(0.5);
    variations.make();
    await pass();
    expect(store.getState().variations?.list.map(({ seed }) => seed)).toEqual([5000, 5001, 5002]);
    await answer(3);
    expect(store.getState().reaction?.inputs.settings.seed).toBe(5000);
    expect(seeds().slice(3)).toEqual([5000, 5001]);
    vi.restoreAllMocks();
  });
});
