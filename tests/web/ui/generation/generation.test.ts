import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Generation } from '../../../../web/ui/generation/generation';
import * as change from '../../support/actions';
import { shiftSet } from '../../../../web/ui/store/actions/timeline';
import { small } from '../../support/small-manifest';
import { ManualGenerator, result } from '../../support/manual-generator';
import { leader, song, still } from '../../support/made-state';

describe('generation', () => {
  let store: change.Store;
  let model: ManualGenerator;
  let stop: () => void;
  let generation: Generation;

  beforeEach(() => {
    vi.useFakeTimers();
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    model = new ManualGenerator();
    generation = new Generation(store, () => Promise.resolve(model.generator));
    stop = generation.dispose;
  });
  afterEach(() => {
    stop();
    vi.useRealTimers();
  });
  const debounced = (): Promise<void> => vi.advanceTimersByTimeAsync(60).then(() => undefined);
  const begin = async (): Promise<void> => {
    change.apply(store, change.leaderLoaded(leader(60)));
    await debounced();
  };

  it('begins by itself once a leader is there, without a song', async () => {
    await begin();
    expect(model.calls).toHaveLength(1);
    expect(model.calls[0]?.request).toMatchObject({ music: null, steps: 10, seed: 7 });
    model.calls[0]?.answer(result());
    await debounced();
    expect(store.getState().reaction).toMatchObject({ seconds: 3, label: null });
    expect(store.getState().job).toBeNull();
  });

  it('waits for a song that is being read and then uses it', async () => {
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0 }));
    await begin();
    expect(model.calls).toHaveLength(0);
    change.apply(store, change.songLoaded(song(2)));
    await debounced();
    expect(model.calls).toHaveLength(1);
    expect(model.calls[0]?.request.music?.frames).toBe(60);
  });

  it('makes another reaction for a song that starts later', async () => {
    change.apply(store, change.songLoaded(song(2)));
    await begin();
    model.calls[0]?.answer(result());
    await debounced();
    change.apply(store, shiftSet(7));
    await debounced();
    expect(model.calls[1]?.request.music).toMatchObject({ frames: 60, start: 7 });
  });

  it('is debounced while a fader moves, and a newer request aborts the older one', async () => {
    await begin();
    for (const value of [0.2, 0.4, 0.6]) {
      change.apply(store, change.guidanceSet('coarse', value));
      await vi.advanceTimersByTimeAsync(30);
    }
    expect(model.calls).toHaveLength(1);
    expect(model.calls[0]?.options.signal?.aborted).toBe(false);
    await debounced();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[0]?.options.signal?.aborted).toBe(true);
    expect(model.calls[1]?.request.guidance[0]).toBeCloseTo(0.6);
    expect(store.getState().problem).toBeNull();
  });

  it('makes nothing when the inputs return to those of the reaction on the stage', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await debounced();
    change.apply(store, change.guidanceSet('fine', 1));
    await debounced();
    expect(store.getState().job).not.toBeNull();
    change.apply(store, change.guidanceSet('fine', 0));
    await debounced();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[1]?.options.signal?.aborted).toBe(true);
    expect(store.getState().job).toBeNull();
  });

  it('stays cancelled until something changes or it is requested', async () => {
    await begin();
    generation.cancel();
    change.apply(store, change.themeSet('light'));
    await debounced();
    expect(model.calls).toHaveLength(1);
    expect(store.getState()).toMatchObject({ job: null, problem: null, reaction: null });
    generation.generate();
    await debounced();
    expect(model.calls).toHaveLength(2);
  });

  it('runs a request for the reaction that is on the stage already', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await debounced();
    generation.generate();
    await debounced();
    change.apply(store, change.themeSet('light'));
    await debounced();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[1]?.options.signal?.aborted).toBe(false);
  });

  it('shows a failure once and keeps the reaction on the stage', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await debounced();
    const { reaction } = store.getState();
    change.apply(store, change.seedSet(8));
    await debounced();
    model.calls[1]?.fail(new Error('boom'));
    await debounced();
    expect(store.getState().problem).toMatchObject({ code: 'generation-failed', remedy: 'generate' });
    expect(store.getState().reaction).toBe(reaction);
    expect(model.calls).toHaveLength(2);
  });

  it('shows the part around the playhead early, within the old reaction, until all is ready', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await debounced();
    const { reaction } = store.getState();
    change.apply(store, change.playbackSet({ time: 1 }));
    change.apply(store, change.seedSet(8));
    await debounced();
    const { options } = model.calls[1] ?? {};
    expect(options?.at).toBe(30);
    const other = { ...still(60), root: new Float32Array(180).fill(1) };
    options?.onPreview?.({ motion: other, locked: other, fresh: { from: 24, to: 48 } });
    const { preview, job } = store.getState();
    expect(job?.previewed).toEqual({ from: 24, to: 48 });
    expect([0, 36, 59].map((frame) => preview?.motion.root[frame * 3])).toEqual([0, 1, 0]);
    options?.onProgress?.({ stage: 'step', done: 1, total: 2, fraction: 0.5 });
    expect(store.getState().job?.previewed).toEqual({ from: 24, to: 48 });
    // What was made before is still what is taken home.
    expect(store.getState().reaction).toBe(reaction);
    model.calls[1]?.answer(result());
    await debounced();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('ignores previews of an aborted request, and removes the preview when cancelled', async () => {
    await begin();
    const preview = { motion: still(60), locked: still(60), fresh: { from: 0, to: 24 } };
    const [older] = model.calls;
    change.apply(store, change.seedSet(8));
    await debounced();
    older?.options.onPreview?.(preview);
    expect(store.getState().preview).toBeNull();
    model.calls[1]?.options.onPreview?.(preview);
    expect(store.getState().preview).not.toBeNull();
    generation.cancel();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('ignores a late answer to an older request', async () => {
    await begin();
    const late = model.calls[0];
    change.apply(store, change.leaderLoaded(leader(90, 'other.bvh')));
    await debounced();
    late?.answer(result());
    await debounced();
    expect(store.getState().reaction).toBeNull();
    model.calls[1]?.answer(result(90));
    await debounced();
    expect(store.getState().reaction?.motion.frames).toBe(90);
  });

  it('does not make a reaction again that came ready-made for the same inputs', async () => {
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
    await debounced();
    expect(model.calls).toHaveLength(0);
  });
});
