import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { VariationMaker } from '../../../../web/ui/generation/variations';
import { Generation } from '../../../../web/ui/generation/generation';
import { undone } from '../../../../web/ui/store/history/history';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { ManualGenerator, result } from '../../support/manual-generator';
import { leader, song } from '../../support/made-state';

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
  const choose = async (...seeds: number[]): Promise<void> => {
    model.seedCalls.at(-1)?.answer(seeds);
    await pass();
  };
  const seeds = (): number[] => model.calls.map(({ request }) => request.seed);
  const list = () => store.getState().variations?.list ?? [];
  const there = (): boolean[] => list().map(({ reaction }) => reaction !== null);
  const make = async (): Promise<void> => {
    variations.make();
    await pass();
  };
  const pickFirst = async (): Promise<void> => {
    await answer(0);
    await make();
    await choose(8, 10, 11);
    await answer(1);
    variations.pick(8);
  };

  beforeEach(async () => {
    vi.useFakeTimers();
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    model = new ManualGenerator();
    const load = (): Promise<typeof model.generator> => Promise.resolve(model.generator);
    generation = new Generation(store, load);
    variations = new VariationMaker(store, load);
    change.apply(store, change.leaderLoaded(leader(60)));
    await pass();
  });
  afterEach(() => {
    variations.dispose();
    generation.dispose();
    vi.useRealTimers();
  });

  it('are chosen from the seeds that follow the present one, then made one after the other', async () => {
    await answer(0);
    expect(store.getState().firstVisit).toBe(true);
    await make();
    expect(store.getState().firstVisit).toBe(false);
    expect(model.seedCalls[0]?.request).toMatchObject({ seeds: [7, 8, 9, 10, 11, 12], count: 3 });
    model.seedCalls[0]?.options.onProgress?.(0.5);
    const [half] = list().map(({ fraction }) => fraction);
    expect(half).toBeGreaterThan(0);
    expect(seeds()).toEqual([7]);
    await choose(8, 10, 11);
    expect(list().map(({ seed }) => seed)).toEqual([8, 10, 11]);
    expect(seeds()).toEqual([7, 8]);
    // The bar never goes back.
    model.calls[1]?.options.onProgress?.({ stage: 'condition', fraction: 0 });
    const begun = list()[0]!.fraction;
    expect(begun).toBeGreaterThan(half!);
    model.calls[1]?.options.onProgress?.({ stage: 'step', fraction: 0.9 });
    expect(list()[0]?.fraction).toBe(0.9);
    await answer(1);
    await answer(2);
    expect(seeds()).toEqual([7, 8, 10, 11]);
    expect(there()).toEqual([true, true, false]);
    await answer(3);
    expect(there()).toEqual([true, true, true]);
    expect(store.getState().variations?.making).toBe(false);
    // The stage keeps its dance.
    expect(store.getState().reaction?.inputs.settings.seed).toBe(7);
  });

  it('have more variety than is set, within its range', async () => {
    await answer(0);
    await make();
    expect(model.seedCalls[0]?.request.request.variety).toBeCloseTo(1.6, 6);
    change.apply(store, change.varietySet(1.8));
    await answer(1);
    variations.cancel();
    change.apply(store, change.songLoaded(song(2)));
    await pass();
    await answer(2);
    await make();
    expect(model.seedCalls[1]?.request.request.variety).toBe(small.guidance.variety.max);
  });

  it('wait for the one that is just being made', async () => {
    await make();
    expect(model.seedCalls).toHaveLength(0);
    await answer(0);
    expect(model.seedCalls).toHaveLength(1);
  });

  it('set their settings when they are picked, and nothing is made again', async () => {
    await pickFirst();
    await pass();
    const { reaction, settings, job } = store.getState();
    expect([reaction?.inputs.settings.seed, settings?.seed, job]).toEqual([8, 8, null]);
    expect(reaction?.inputs.settings).toEqual(settings);
    // The second is still on its way.
    expect(seeds()).toEqual([7, 8, 10]);
    expect(model.calls[2]?.options.signal?.aborted).toBe(false);
    change.apply(store, undone());
    await pass();
    expect(store.getState().reaction?.inputs.settings.seed).toBe(7);
    expect(store.getState().settings).toMatchObject({ seed: 7, variety: 1 });
    expect(seeds()).toEqual([7, 8, 10]);
  });

  it('take over a reaction that is there already', async () => {
    await pickFirst();
    const { leader: first, settings } = store.getState();
    change.apply(store, change.leaderLoaded(leader(60, 'other.bvh')));
    await pass();
    await answer(3);
    change.apply(store, change.leaderLoaded(first!));
    change.apply(store, change.settingsSet({ ...settings!, variety: 1 }));
    await pass();
    await answer(4);
    await make();
    const before = seeds().length;
    await choose(8, 9, 10);
    expect(there()).toEqual([true, false, false]);
    expect(seeds().slice(before)).toEqual([9]);
  });

  it('stop when cancelled, keep what is made, and go on when requested again', async () => {
    await answer(0);
    await make();
    variations.cancel();
    expect(model.seedCalls[0]?.options.signal?.aborted).toBe(true);
    expect(list().map(({ fraction }) => fraction)).toEqual([0, 0, 0]);
    await make();
    await choose(7, 8, 9);
    await answer(1);
    variations.cancel();
    await pass();
    expect(there()).toEqual([true, false, false]);
    expect(model.calls[2]?.options.signal?.aborted).toBe(true);
    await make();
    // The seeds are chosen.
    expect(model.seedCalls).toHaveLength(2);
    expect(seeds()).toEqual([7, 7, 8, 8]);
  });

  it('stay for another seed and are dropped when other settings are chosen', async () => {
    await answer(0);
    await make();
    await choose(8, 10, 11);
    change.apply(store, change.seedSet(99));
    expect(store.getState().variations).not.toBeNull();
    change.apply(store, change.guidanceSet('coarse', 1));
    await pass();
    expect(store.getState().variations).toBeNull();
    expect(model.calls[1]?.options.signal?.aborted).toBe(true);
  });

  it('are dropped when another model comes, which takes over no take of the one before', async () => {
    await pickFirst();
    await pass();
    change.apply(store, change.modelOpened({ ...small, id: 'other' }, 7));
    expect(store.getState().variations).toBeNull();
    expect(model.calls[2]?.options.signal?.aborted).toBe(true);
    await pass();
    await answer(3);
    await make();
    await choose(8, 10, 11);
    expect(there()).toEqual([false, false, false]);
    expect(seeds().slice(4)).toEqual([8]);
  });

  it('are three others the next time', async () => {
    await answer(0);
    await make();
    await choose(8, 10, 11);
    for (const index of [1, 2, 3]) await answer(index);
    await make();
    expect(model.seedCalls[1]?.request.seeds).toEqual([13, 14, 15, 16, 17, 18]);
    expect(there()).toEqual([false, false, false]);
    expect(store.getState().settings?.seed).toBe(7);
  });

  it('have the same variety the next time, also after one was picked', async () => {
    const asked = (): (number | undefined)[] =>
      model.seedCalls.map(({ request: { request } }) => request.variety);
    await answer(0);
    await make();
    await choose(8, 10, 11);
    for (const index of [1, 2, 3]) await answer(index);
    variations.pick(10);
    await make();
    expect(asked()).toEqual([1.6, 1.6]);
    await choose(13, 14, 15);
    for (const index of [4, 5, 6]) await answer(index);
    change.apply(store, undone());
    await make();
    expect(asked()).toEqual([1.6, 1.6, 1.6]);
  });
});
