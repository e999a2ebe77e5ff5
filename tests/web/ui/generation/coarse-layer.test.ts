import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type {
  CoarseRequest,
  GeneratedMotion,
  GenerateOptions,
  Generator,
} from '../../../../web/model/client';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { coarseIsMissing, createCoarseLayer } from '../../../../web/ui/generation/coarse-layer';
import { coarseMotion, otherCoarseMotion } from '../../../../web/ui/store/reactor-motion';
import type { Reaction } from '../../../../web/ui/store/reaction';
import * as change from '../../support/actions';
import { compareSet, takesSwapped, letterGiven } from '../../../../web/ui/store/actions/takes';
import { small } from '../../support/small-manifest';
import { leader, madeSettings, song, still } from '../../support/made-state';

/** A model whose answers the test gives. */
class ManualGenerator {
  readonly calls: {
    request: CoarseRequest;
    signal: AbortSignal | undefined;
    answer: (motion: SolvedMotion, locked?: SolvedMotion) => void;
    fail: (error: Error) => void;
  }[] = [];
  readonly generator = {
    manifest: small,
    backend: { name: 'wasm', reason: '', threads: 1 },
    generate: () => Promise.reject(new Error('Nothing is generated here.')),
    differingSeeds: () => Promise.reject(new Error('Nothing is generated here.')),
    coarse: (request: CoarseRequest, { signal }: Pick<GenerateOptions, 'signal'> = {}) =>
      new Promise<GeneratedMotion>((resolve, fail) => {
        const answer = (motion: SolvedMotion, locked = motion): void => resolve({ motion, locked });
        this.calls.push({ request, signal, answer, fail });
        signal?.addEventListener('abort', () => {
          fail(signal.reason as Error);
        });
      }),
    dispose: () => undefined,
  } satisfies Generator;
}

describe('the coarse layer', () => {
  let store: change.Store;
  let model: ManualGenerator;
  let stop: () => void;
  /** What promises do comes before the next task. */
  const turn = (): Promise<void> => new Promise((done) => setTimeout(done));
  const state = () => store.getState();
  const reaction = (latents: Float32Array | null): Reaction => {
    const inputs = { leader: leader(60), song: null, shift: 0, settings: madeSettings };
    return { motion: still(60), latents, inputs, label: latents ? null : 'demo reaction', seconds: 1 };
  };
  const show = (shown: Reaction) => change.apply(store, change.reactionAdded(shown));
  const toggle = () => change.apply(store, change.overlayToggled('ghost'));

  beforeEach(() => {
    store = change.createAppStore('dark');
    change.apply(store, change.footLockSet(false));
    model = new ManualGenerator();
    stop = createCoarseLayer(store, () => Promise.resolve(model.generator));
  });
  afterEach(() => {
    stop();
    vi.restoreAllMocks();
  });

  it('is decoded when its overlay is switched on, from the latents of the reaction, its leader and its song', async () => {
    const made = reaction(new Float32Array([1, 2]));
    const shown = { ...made, inputs: { ...made.inputs, song: song(100), shift: 3 } };
    show(shown);
    await turn();
    expect(model.calls).toHaveLength(0);
    toggle();
    await turn();
    expect(state().coarse).toEqual({ motion: null, other: null, decoding: true });
    expect(model.calls[0]?.request).toEqual({
      leader: shown.inputs.leader.file.clip,
      fitted: shown.inputs.leader.motion,
      music: {
        features: shown.inputs.song.data.features,
        frames: shown.inputs.song.data.frames,
        beats: shown.inputs.song.data.rhythm.beats,
        start: 3,
      },
      latents: shown.latents,
      role: 'reactor',
      height: undefined,
      holdHands: true,
    });
    const motion = still(60);
    model.calls[0]?.answer(motion);
    await turn();
    expect(state().coarse).toEqual({ motion, other: null, decoding: false });
    expect(coarseMotion(state())).toBe(motion);
    toggle();
    expect(coarseMotion(state())).toBeNull();
  });

  it('is drawn with the feet that were locked where it was decoded, while foot lock is on', async () => {
    show(reaction(new Float32Array([1])));
    toggle();
    await turn();
    const [motion, locked] = [still(60), still(60)];
    model.calls[0]?.answer(motion, locked);
    await turn();
    expect(coarseMotion(state())).toBe(motion);
    change.apply(store, change.footLockSet(true));
    expect(coarseMotion(state())).toBe(locked);
  });

  it('is decoded once for each reaction, however often takes and the overlay are switched', async () => {
    const [one, two] = [reaction(new Float32Array([1])), reaction(new Float32Array([2]))];
    toggle();
    const motions = [];
    for (const each of [one, two]) {
      show(each);
      await turn();
      const motion = still(60);
      motions.push(motion);
      model.calls.at(-1)?.answer(motion);
      await turn();
    }
    toggle();
    show({ ...one });
    toggle();
    expect(state().coarse).toEqual({ motion: motions[0], other: null, decoding: false });
    show(two);
    expect(state().coarse.motion).toBe(motions[1]);
    await turn();
    expect(model.calls).toHaveLength(2);
  });

  it('is decoded for both of two takes side by side, the one on the stage first, and flips with them', async () => {
    const dancer = leader(60);
    const made = (seed: number): Reaction => {
      const { inputs, ...rest } = reaction(new Float32Array([seed]));
      return { ...rest, inputs: { ...inputs, leader: dancer, settings: { ...inputs.settings, seed } } };
    };
    change.apply(store, change.manifestLoaded(small, 1));
    change.apply(store, change.leaderLoaded(dancer));
    change.apply(store, change.reactionAdded(made(1), { id: 'one', at: 1 }));
    change.apply(store, change.reactionAdded(made(2), { id: 'two', at: 2 }));
    change.apply(store, letterGiven('one', 'B'));
    toggle();
    change.apply(store, compareSet('ghost'));
    await turn();
    // In one picture, the other take's would only be in the way.
    expect(model.calls.map(({ request }) => [...request.latents])).toEqual([[2]]);
    change.apply(store, compareSet('side'));
    await turn();
    expect(model.calls.map(({ request }) => [...request.latents])).toEqual([[2], [2]]);
    const [two, one] = [still(60), still(60)];
    model.calls[1]?.answer(two);
    await turn();
    expect(state().coarse).toEqual({ motion: two, other: null, decoding: true });
    expect([...model.calls[2]!.request.latents]).toEqual([1]);
    model.calls[2]?.answer(one);
    await turn();
    expect(state().coarse).toEqual({ motion: two, other: one, decoding: false });
    expect(otherCoarseMotion(state())).toBe(one);
    change.apply(store, takesSwapped());
    expect(state().coarse).toEqual({ motion: one, other: two, decoding: false });
    change.apply(store, compareSet('side'));
    expect(state().coarse).toEqual({ motion: one, other: null, decoding: false });
    await turn();
    expect(model.calls).toHaveLength(3);
  });

  it('aborts decoding when another reaction comes, and keeps the old layer until the next is decoded', async () => {
    toggle();
    show(reaction(new Float32Array([1])));
    await turn();
    const first = still(60);
    model.calls[0]?.answer(first);
    await turn();
    show(reaction(new Float32Array([2])));
    await turn();
    expect(state().coarse).toEqual({ motion: first, other: null, decoding: true });
    show(reaction(new Float32Array([3])));
    await turn();
    expect(model.calls[1]?.signal?.aborted).toBe(true);
    expect(state().coarse.decoding).toBe(true);
    const last = still(60);
    model.calls[2]?.answer(last);
    await turn();
    expect(state().coarse).toEqual({ motion: last, other: null, decoding: false });
    change.apply(store, change.leaderLoaded(leader(30)));
    expect(state().coarse).toEqual({ motion: null, other: null, decoding: false });
  });

  it('is missing from a reaction that came ready-made or from another model', async () => {
    toggle();
    show(reaction(null));
    await turn();
    expect(coarseIsMissing(state())).toBe(true);
    expect(model.calls).toHaveLength(0);
    show(reaction(new Float32Array([1])));
    expect(coarseIsMissing(state())).toBe(false);
    change.apply(store, change.modelOpened(small, 1));
    expect(coarseIsMissing(state())).toBe(true);
    expect(model.calls.every(({ signal }) => signal?.aborted)).toBe(true);
  });

  it('shows a failure and switches the overlay off, so that it is not tried again by itself', async () => {
    show(reaction(new Float32Array([1])));
    toggle();
    await turn();
    model.calls[0]?.fail(new Error('boom'));
    await turn();
    expect(state().problem).toMatchObject({ code: 'coarse-failed', remedy: 'generate' });
    expect(state().overlays.ghost).toBe(false);
    expect(state().coarse).toEqual({ motion: null, other: null, decoding: false });
    await turn();
    expect(model.calls).toHaveLength(1);
  });
});
