import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { AppError } from '../../../../web/common/error';
import type { Generator, Preview } from '../../../../web/model/client';
import { Generation } from '../../../../web/ui/generation/generation';
import * as change from '../../support/actions';
import { readyInputs } from '../../../../web/ui/store/selectors';
import { projectCleared, projectOpened } from '../../../../web/ui/store/actions/project';
import { redone, undone } from '../../../../web/ui/store/history/history';
import { modelProblem } from '../../../../web/ui/store/problems';
import { shiftSet } from '../../../../web/ui/store/actions/timeline';
import { small } from '../../support/small-manifest';
import { ManualGenerator, result } from '../../support/manual-generator';
import { leader, song, still } from '../../support/made-state';

/** Frames of a preview, with the root at x = `at`. */
function part(from: number, frames: number, at: number): Preview {
  const motion = { ...still(frames), root: new Float32Array(frames * 3).fill(at) };
  return { motion, locked: motion, from };
}

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
  /** Promises that have their answers go on. */
  const settled = (): Promise<void> => vi.advanceTimersByTimeAsync(0).then(() => undefined);
  const begin = async (): Promise<void> => {
    change.apply(store, change.leaderLoaded(leader(60)));
    await settled();
  };

  it('begins by itself once a leader is there, without a song', async () => {
    await begin();
    expect(model.calls).toHaveLength(1);
    expect(model.calls[0]?.request).toMatchObject({ music: null, seed: 7 });
    model.calls[0]?.answer(result());
    await settled();
    expect(store.getState().reaction).toMatchObject({ seconds: 3, label: null });
    expect(store.getState().job).toBeNull();
  });

  it('ends the first visit when another dance to the same files is asked for', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    // As when the demo's song is there a moment before its reaction.
    change.apply(store, change.songLoaded(song(2)));
    await settled();
    expect(model.calls).toHaveLength(2);
    expect(store.getState().firstVisit).toBe(true);
    model.calls[1]?.answer(result());
    await settled();
    change.apply(store, change.seedSet(8));
    await settled();
    expect(store.getState().firstVisit).toBe(false);
  });

  it('waits for a song that is being read and then uses it', async () => {
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0 }));
    await begin();
    expect(model.calls).toHaveLength(0);
    change.apply(store, change.songLoaded(song(2)));
    await settled();
    expect(model.calls).toHaveLength(1);
    expect(model.calls[0]?.request.music?.frames).toBe(60);
  });

  it('goes on while a song is read, but not for a leader that is replaced meanwhile', async () => {
    await begin();
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0 }));
    await settled();
    expect(model.calls[0]?.options.signal?.aborted).toBe(false);
    change.apply(store, change.leaderLoaded(leader(90, 'other.bvh')));
    await settled();
    expect(store.getState().job).toBeNull();
    model.calls[0]?.answer(result());
    await settled();
    expect(store.getState().reaction).toBeNull();
    change.apply(store, change.songLoaded(song(3)));
    await settled();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[1]?.request.leader.frames).toBe(90);
  });

  it('ends when the roles are swapped while a song is read, and begins again when they are swapped back', async () => {
    await begin();
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0 }));
    change.apply(store, change.rolesSwapped());
    await settled();
    expect(model.calls[0]?.options.signal?.aborted).toBe(true);
    expect(store.getState().job).toBeNull();
    change.apply(store, change.rolesSwapped());
    change.apply(store, change.readingSet('song', null));
    await settled();
    expect(model.calls).toHaveLength(2);
  });

  it('ends when a project without a leader leaves none on the page', async () => {
    change.apply(store, projectOpened({ leader: leader(60) }));
    await settled();
    change.apply(store, projectOpened({ leader: null, reaction: null }));
    await settled();
    expect(model.calls[0]?.options.signal?.aborted).toBe(true);
    expect(store.getState().job).toBeNull();
  });

  it('begins again when starting over, which has cancelled it, is undone', async () => {
    await begin();
    generation.cancel();
    change.apply(store, projectCleared(small, 3));
    await settled();
    change.apply(store, undone());
    await settled();
    expect(model.calls).toHaveLength(2);
  });

  it('shows no part of a dance within the one that undo or a project brings', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    change.apply(store, change.seedSet(8));
    const preview = async (): Promise<void> => {
      await settled();
      void model.calls.at(-1)?.options.onPreview?.(part(24, 24, 1));
      expect(store.getState().preview).not.toBeNull();
    };
    await preview();
    change.apply(store, projectOpened({ leader: leader(90), reaction: null }));
    expect(store.getState().preview).toBeNull();
    change.apply(store, undone());
    await preview();
    change.apply(store, redone());
    expect(store.getState().preview).toBeNull();
  });

  it('makes another reaction for a song that starts later', async () => {
    change.apply(store, change.songLoaded(song(2)));
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    change.apply(store, shiftSet(7));
    await settled();
    expect(model.calls[1]?.request.music).toMatchObject({ frames: 60, start: 7 });
  });

  it('asks at once after a change of the seed, and aborts the request before', async () => {
    await begin();
    change.apply(store, change.seedSet(8));
    change.apply(store, change.seedSet(9));
    await settled();
    expect(model.calls.map(({ request }) => request.seed)).toEqual([7, 9]);
    expect(model.calls[0]?.options.signal?.aborted).toBe(true);
    expect(store.getState().problem).toBeNull();
  });

  it('shows a preview of each request while a fader moves, and goes on with the newest weights', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    const moved = async (value: number): Promise<void> => {
      change.apply(store, change.guidanceSet('coarse', value));
      await settled();
    };
    for (const value of [0.1, 0.2, 0.3]) await moved(value);
    expect(model.calls).toHaveLength(2);
    const first = model.calls[1]!;
    expect(first.options.signal?.aborted).toBe(false);
    void first.options.onPreview?.(part(24, 24, 1));
    await settled();
    // The older request is dropped after its preview, and the value between is never asked for.
    expect(first.options.signal?.aborted).toBe(true);
    expect(model.calls.slice(2).map(({ request }) => request.guidance[0])).toEqual([Math.fround(0.3)]);
    // Once the preview is shown, a newer value does not wait for the whole.
    const second = model.calls[2]!;
    void second.options.onPreview?.(part(24, 24, 2));
    await settled();
    expect(second.options.signal?.aborted).toBe(false);
    await moved(0.4);
    expect(second.options.signal?.aborted).toBe(true);
    void model.calls[3]?.options.onPreview?.(part(24, 24, 3));
    model.calls[3]?.answer(result());
    await settled();
    expect(store.getState()).toMatchObject({ job: null, preview: null });
    expect(store.getState().reaction?.inputs.settings.guidance['upper']?.['coarse']).toBe(0.4);
  });

  it('makes nothing when the inputs return to those of the reaction on the stage', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    change.apply(store, change.guidanceSet('fine', 1));
    await settled();
    expect(store.getState().job).not.toBeNull();
    change.apply(store, change.guidanceSet('fine', 0));
    await settled();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[1]?.options.signal?.aborted).toBe(true);
    expect(store.getState().job).toBeNull();
  });

  it('stays cancelled until something changes or it is requested', async () => {
    await begin();
    generation.cancel();
    change.apply(store, change.themeSet('light'));
    await settled();
    expect(model.calls).toHaveLength(1);
    expect(store.getState()).toMatchObject({ job: null, problem: null, reaction: null });
    generation.generate();
    await settled();
    expect(model.calls).toHaveLength(2);
  });

  it('runs a request for the reaction that is on the stage already', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    generation.generate();
    await settled();
    change.apply(store, change.themeSet('light'));
    await settled();
    expect(model.calls).toHaveLength(2);
    expect(model.calls[1]?.options.signal?.aborted).toBe(false);
  });

  it('shows a failure once and keeps the reaction on the stage', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    const { reaction } = store.getState();
    change.apply(store, change.seedSet(8));
    await settled();
    model.calls[1]?.fail(new Error('boom'));
    await settled();
    expect(store.getState().problem).toMatchObject({ code: 'generation-failed', remedy: 'generate' });
    expect(store.getState().reaction).toBe(reaction);
    expect(model.calls).toHaveLength(2);
  });

  it('shows the part in view early, within the old reaction, until all is ready', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    const { reaction } = store.getState();
    change.apply(store, change.playbackSet({ time: 1, playing: true, speed: 0.5 }));
    change.apply(store, change.guidanceSet('coarse', 0.5));
    await settled();
    const { options } = model.calls[1] ?? {};
    expect(options?.playhead).toMatchObject({ frame: 30, rate: 15 });
    void options?.onPreview?.(part(24, 24, 1));
    const rootOf = (frame: number) => store.getState().preview?.motion.root[frame * 3];
    expect([0, 23, 24, 47, 48, 59].map(rootOf)).toEqual([0, 0, 1, 1, 0, 0]);
    // What was made before is still what is taken home.
    expect(store.getState().reaction).toBe(reaction);
    model.calls[1]?.answer(result());
    await settled();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('shows no part of another body within the reaction', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    change.apply(store, change.seedSet(8));
    await settled();
    const { motion, ...rest } = part(24, 24, 1);
    const taller = { ...motion, offsets: new Float32Array(66).fill(0.1) };
    void model.calls[1]?.options.onPreview?.({ ...rest, motion: taller });
    expect(store.getState().preview).toBeNull();
  });

  it('ignores previews of an aborted request, and removes the preview when cancelled', async () => {
    await begin();
    model.calls[0]?.answer(result());
    await settled();
    change.apply(store, change.guidanceSet('fine', 0.5));
    await settled();
    change.apply(store, change.seedSet(8));
    await settled();
    void model.calls[1]?.options.onPreview?.(part(0, 24, 1));
    expect(store.getState().preview).toBeNull();
    void model.calls[2]?.options.onPreview?.(part(0, 24, 1));
    expect(store.getState().preview).not.toBeNull();
    generation.cancel();
    expect(store.getState()).toMatchObject({ preview: null, job: null });
  });

  it('ignores a late answer to an older request', async () => {
    await begin();
    const late = model.calls[0];
    change.apply(store, change.leaderLoaded(leader(90, 'other.bvh')));
    await settled();
    late?.answer(result());
    await settled();
    expect(store.getState().reaction).toBeNull();
    model.calls[1]?.answer(result(90));
    await settled();
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
    await settled();
    expect(model.calls).toHaveLength(0);
  });

  it('aborts what it has begun when a ready-made reaction comes a moment later', async () => {
    await begin();
    const inputs = readyInputs(store.getState())!;
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
    await settled();
    expect(model.calls[0]?.options.signal?.aborted).toBe(true);
    expect(store.getState()).toMatchObject({ job: null, reaction: { label: 'demo reaction' } });
  });

  describe('when the model could not be loaded', () => {
    const broken = new AppError('download-failed', 'It broke off.', 'Try again.');
    let attempt: Promise<Generator>;

    /** Asks for a dance while the model is being loaded, which then fails. */
    async function fail(meanwhile = (): void => undefined): Promise<void> {
      stop();
      let refuse = (): void => undefined;
      attempt = new Promise((_, reject) => (refuse = () => reject(broken)));
      generation = new Generation(store, () => attempt);
      stop = generation.dispose;
      await begin();
      meanwhile();
      change.apply(store, change.modelChanged({ phase: 'failed', problem: modelProblem(broken) }));
      refuse();
      await settled();
      expect(store.getState()).toMatchObject({ job: null, problem: null });
      attempt = Promise.resolve(model.generator);
    }

    it('makes what waited for it as soon as it is loaded once more', async () => {
      await fail();
      generation.resume();
      await settled();
      model.calls[0]?.answer(result());
      await settled();
      expect(store.getState().reaction).not.toBeNull();
      generation.resume();
      await settled();
      expect(model.calls).toHaveLength(1);
    });

    it('does not make what the visitor has cancelled before', async () => {
      await fail(() => generation.cancel());
      generation.resume();
      await settled();
      expect(model.calls).toHaveLength(0);
    });
  });
});
