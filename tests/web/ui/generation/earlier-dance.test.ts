import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { createEarlierDance } from '../../../../web/ui/generation/earlier-dance';
import { compareSet, letterGiven } from '../../../../web/ui/store/actions/takes';
import { undone } from '../../../../web/ui/store/history/history';
import { earlierMotion } from '../../../../web/ui/store/reactor-motion';
import { readyInputs } from '../../../../web/ui/store/selectors';
import type { Reaction } from '../../../../web/ui/store/reaction';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { leader, song, still } from '../../support/made-state';

describe('the dance before a change', () => {
  let store: change.Store;
  let stop: () => void;

  const apply = (...changes: change.Change[]): void => {
    for (const one of changes) change.apply(store, one);
  };
  /** A reaction to what is set now comes onto the stage. */
  const made = (): Reaction => {
    const inputs = readyInputs(store.getState());
    if (!inputs) throw new Error('There is nothing to react to.');
    const reaction = { motion: still(90), latents: null, inputs, label: null, seconds: 1 };
    if (!store.getState().job) apply(job);
    apply(change.reactionAdded(reaction));
    return reaction;
  };
  const job = change.jobChanged({ stage: 'step', fraction: 0.9 });
  const previewed = (): void => apply(job, change.previewShown({ motion: still(90), locked: still(90) }));
  const shown = () => earlierMotion({ ...store.getState(), footLock: false });
  const after = (seconds: number): void => void vi.advanceTimersByTime(seconds * 1000);

  beforeEach(() => {
    vi.useFakeTimers();
    store = change.createAppStore('dark');
    stop = createEarlierDance(store);
    apply(change.manifestLoaded(small, 7), change.leaderLoaded(leader(90)));
  });
  afterEach(() => {
    stop();
    vi.useRealTimers();
  });

  it('is shown for two seconds after a setting has changed it', () => {
    const first = made();
    expect(shown()).toBeNull();
    for (const setting of [
      change.guidanceSet('coarse', 0.5),
      change.varietySet(1.5),
      change.presetChosen({ ...store.getState().settings!, music: 0 }),
      change.seedSet(8),
    ]) {
      const before = store.getState().reaction;
      apply(setting);
      expect(shown()).toBeNull();
      made();
      expect(shown()).toBe(before?.motion);
      after(1.9);
      expect(shown()).toBe(before?.motion);
      after(0.2);
      expect(shown()).toBeNull();
    }
    expect(store.getState().reaction).not.toBe(first);
  });

  it.each([1.5, 5])('stays the one from before a drag, also after a rest of %f seconds', (rest) => {
    const { motion } = made();
    apply(change.dragBegun());
    for (const value of [0.1, 0.3, 0.6]) {
      apply(change.guidanceSet('coarse', value));
      previewed();
      expect(shown()).toBe(motion);
      after(rest);
      made();
      expect(shown()).toBe(rest < 2 ? motion : null);
    }
    apply(change.guidanceSet('coarse', 0.9), change.dragEnded());
    previewed();
    made();
    expect(shown()).toBe(motion);
    after(2.1);
    expect(shown()).toBeNull();
    const dragged = store.getState().reaction!;
    apply(change.seedSet(8));
    made();
    expect(shown()).toBe(dragged.motion);
  });

  it('stays the one from before the first of several keys', () => {
    const { motion } = made();
    for (const value of [0.05, 0.1, 0.15]) {
      apply(change.guidanceSet('coarse', value));
      previewed();
      made();
      after(1.5);
      expect(shown()).toBe(motion);
    }
    after(0.6);
    expect(shown()).toBeNull();
  });

  it('appears with the preview, and not once more with the whole', () => {
    made();
    apply(change.guidanceSet('fine', 0.5));
    previewed();
    after(3);
    made();
    expect(shown()).toBeNull();
    const second = store.getState().reaction!;
    apply(change.guidanceSet('fine', 0.7));
    previewed();
    expect(shown()).toBe(second.motion);
  });

  it('stays when the new dance is made again', () => {
    const { motion } = made();
    apply(change.seedSet(8));
    made();
    after(1);
    made();
    expect(shown()).toBe(motion);
    after(1.1);
    expect(shown()).toBeNull();
  });

  it('is not drawn over the same dance', () => {
    made();
    apply(change.guidanceSet('coarse', 0.5));
    made();
    apply(change.guidanceSet('coarse', 0));
    made();
    expect(shown()).toBeNull();
  });

  it('is the one that undoing, a take or another seed has replaced', () => {
    const first = made();
    apply(change.seedSet(8));
    const second = made();
    expect(shown()).toBe(first.motion);
    apply(undone());
    expect(store.getState().reaction).toBe(first);
    expect(shown()).toBe(second.motion);
    // A reaction that was there before, as a picked variation is, although only weights differ.
    after(3);
    apply(change.guidanceSet('coarse', 0.5));
    const third = made();
    expect(shown()).toBe(first.motion);
    apply(undone());
    expect(shown()).toBe(third.motion);
  });

  it('is not shown for another leader, song or role', () => {
    const first = made();
    apply(change.guidanceSet('coarse', 0.5));
    made();
    expect(shown()).toBe(first.motion);
    apply(change.songLoaded(song(3)));
    made();
    expect(shown()).toBeNull();
    apply(change.guidanceSet('coarse', 0.6));
    made();
    expect(shown()).not.toBeNull();
    apply(change.leaderLoaded(leader(90)));
    expect(shown()).toBeNull();
    made();
    expect(shown()).toBeNull();
    apply(change.rolesSwapped());
    const swapped = made();
    expect(shown()).toBeNull();
    apply(undone());
    expect(store.getState().reaction).not.toBe(swapped);
    expect(shown()).toBeNull();
  });

  it('is not shown while takes are compared', () => {
    made();
    apply(change.seedSet(8));
    made();
    const [, older] = store.getState().takes;
    apply(letterGiven(older!.id, 'B'));
    expect(shown()).not.toBeNull();
    apply(compareSet('side'));
    expect(shown()).toBeNull();
    apply(change.seedSet(9));
    made();
    apply(compareSet('side'));
    expect(shown()).toBeNull();
  });
});
