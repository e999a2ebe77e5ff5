import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createGeneration } from '../../../../web/ui/generation/generation';
import * as change from '../../support/actions';
import { shiftSet } from '../../../../web/ui/store/actions/timeline';
import { small } from '../../support/small-manifest';
import { Hand, result } from '../../support/manual-generator';
import { leader, song, still } from '../../support/made-state';

describe('generation', () => {
  let store: change.Store;
  let hand: Hand;
  let stop: () => void;
  let generation: ReturnType<typeof createGeneration>;

  beforeEach(() => {
    vi.useFakeTimers();
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    hand = new Hand();
    generation = createGeneration(store, () => Promise.resolve(hand.generator));
    stop = generation.dispose;
  });
  afterEach(() => {
    stop();
    vi.useRealTimers();
  });
  const still60 = (): Promise<void> => vi.advanceTimersByTimeAsync(60).then(() => undefined);
  const begin = async (): Promise<void> => {
    change.apply(store, change.leaderLoaded(leader(60)));
    await still60();
  };

  it('begins by itself once a leader is there, without a song', async () => {
    await begin();
    expect(hand.calls).toHaveLength(1);
    expect(hand.calls[0]?.request).toMatchObject({ music: null, steps: 10, seed: 7 });
    hand.calls[0]?.answer(result());
    await still60();
    expect(store.getState().reaction).toMatchObject({ seconds: 3, label: null });
    expect(store.getState().job).toBeNull();
  });

  it('waits for a song that is being read and then hears it', async () => {
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0 }));
    await begin();
    expect(hand.calls).toHaveLength(0);
    change.apply(store, change.songLoaded(song(2)));
    await still60();
    expect(hand.calls).toHaveLength(1);
    expect(hand.calls[0]?.request.music?.frames).toBe(60);
  });

  it('makes another reaction for a song that starts later', async () => {
    change.apply(store, change.songLoaded(song(2)));
    await begin();
    hand.calls[0]?.answer(result());
    await still60();
    change.apply(store, shiftSet(7));
    await still60();
    expect(hand.calls[1]?.request.music).toMatchObject({ frames: 60, start: 7 });
  });

  it('waits for stillness while a fader moves, and the newest wish drops the older ones', async () => {
    await begin();
    for (const value of [0.2, 0.4, 0.6]) {
      change.apply(store, change.guidanceSet('coarse', value));
      await vi.advanceTimersByTimeAsync(30);
    }
    expect(hand.calls).toHaveLength(1);
    expect(hand.calls[0]?.options.signal?.aborted).toBe(false);
    await still60();
    expect(hand.calls).toHaveLength(2);
    expect(hand.calls[0]?.options.signal?.aborted).toBe(true);
    expect(hand.calls[1]?.request.guidance[0]).toBeCloseTo(0.6);
    expect(store.getState().problem).toBeNull();
  });

  it('makes nothing when the wish returns to what is on the stage', async () => {
    await begin();
    hand.calls[0]?.answer(result());
    await still60();
    change.apply(store, change.guidanceSet('fine', 1));
    await still60();
    expect(store.getState().job).not.toBeNull();
    change.apply(store, change.guidanceSet('fine', 0));
    await still60();
    expect(hand.calls).toHaveLength(2);
    expect(hand.calls[1]?.options.signal?.aborted).toBe(true);
    expect(store.getState().job).toBeNull();
  });

  it('stays cancelled until something changes or it is asked for', async () => {
    await begin();
    generation.cancel();
    change.apply(store, change.themeSet('light'));
    await still60();
    expect(hand.calls).toHaveLength(1);
    expect(store.getState()).toMatchObject({ job: null, problem: null, reaction: null });
    generation.generate();
    await still60();
    expect(hand.calls).toHaveLength(2);
  });

  it('lets a reaction asked for again run, though it is on the stage', async () => {
    await begin();
    hand.calls[0]?.answer(result());
    await still60();
    generation.generate();
    await still60();
    change.apply(store, change.themeSet('light'));
    await still60();
    expect(hand.calls).toHaveLength(2);
    expect(hand.calls[1]?.options.signal?.aborted).toBe(false);
  });

  it('tells a failure in words once and keeps what is on the stage', async () => {
    await begin();
    hand.calls[0]?.answer(result());
    await still60();
    const { reaction } = store.getState();
    change.apply(store, change.seedSet(8));
    await still60();
    hand.calls[1]?.fail(new Error('boom'));
    await still60();
    expect(store.getState().problem).toMatchObject({ code: 'generation-failed', remedy: 'generate' });
    expect(store.getState().reaction).toBe(reaction);
    expect(hand.calls).toHaveLength(2);
  });

  it('shows the part under the playhead early, among what was there, until the whole is ready', async () => {
    await begin();
    hand.calls[0]?.answer(result());
    await still60();
    const { reaction } = store.getState();
    change.apply(store, change.playbackSet({ time: 1 }));
    change.apply(store, change.seedSet(8));
    await still60();
    const { options } = hand.calls[1] ?? {};
    expect(options?.at).toBe(30);
    const moved = { ...still(60), root: new Float32Array(180).fill(1) };
    options?.onPreview?.({ motion: moved, locked: moved, fresh: { from: 24, to: 48 } });
    const { preview, job } = store.getState();
    expect(job?.previewed).toEqual({ from: 24, to: 48 });
    expect([0, 36, 59].map((frame) => preview?.motion.root[frame * 3])).toEqual([0, 1, 0]);
    options?.onProgress?.({ stage: 'step', done: 1, total: 2, fraction: 0.5 });
    expect(store.getState().job?.previewed).toEqual({ from: 24, to: 48 });
    // What was made before is still what is taken home.
    expect(store.getState().reaction).toBe(reaction);
    hand.calls[1]?.answer(result());
    await still60();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('a newer wish drops the older one with its preview to come, and cancelling takes the preview away', async () => {
    await begin();
    const preview = { motion: still(60), locked: still(60), fresh: { from: 0, to: 24 } };
    const [older] = hand.calls;
    change.apply(store, change.seedSet(8));
    await still60();
    older?.options.onPreview?.(preview);
    expect(store.getState().preview).toBeNull();
    hand.calls[1]?.options.onPreview?.(preview);
    expect(store.getState().preview).not.toBeNull();
    generation.cancel();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('a late answer to an older wish is not shown', async () => {
    await begin();
    const late = hand.calls[0];
    change.apply(store, change.leaderLoaded(leader(90, 'other.bvh')));
    await still60();
    late?.answer(result());
    await still60();
    expect(store.getState().reaction).toBeNull();
    hand.calls[1]?.answer(result(90));
    await still60();
    expect(store.getState().reaction?.motion.frames).toBe(90);
  });

  it('does not make anew what came ready-made for the same wish', async () => {
    const one = leader(60);
    change.apply(store, change.leaderLoaded(one));
    const { settings } = store.getState();
    if (!settings) throw new Error('no settings');
    const inputs = { leader: one, song: null, shift: 0, settings };
    change.apply(
      store,
      change.reactionAdded({
        motion: still(60),
        latents: null,
        inputs,
        label: 'demo reaction',
        seconds: null,
      }),
    );
    await still60();
    expect(hand.calls).toHaveLength(0);
  });
});
