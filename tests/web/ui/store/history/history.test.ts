import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { LoadedLeader } from '../../../../../web/ui/store/reaction';
import * as change from '../../../support/actions';
import { projectCleared } from '../../../../../web/ui/store/actions/project';
import { takeDeleted } from '../../../../../web/ui/store/actions/takes';
import { previewShown } from '../../../../../web/ui/store/actions/reaction';
import { shiftSet } from '../../../../../web/ui/store/actions/timeline';
import {
  loadingJoined,
  redone,
  shiftJoined,
  undone,
  withoutUndo,
} from '../../../../../web/ui/store/history/history';
import { ask, undoLast } from '../../../../../web/ui/store/history/asked';
import { currentInputs, takeOnStage } from '../../../../../web/ui/store/take';
import { leader, song, still } from '../../../support/made-state';
import { small } from '../../../support/small-manifest';

/** A leader that takes so many megabytes. */
const large = (megabytes: number): LoadedLeader => ({
  ...leader(30),
  files: [{ name: 'large.bvh', bytes: new Uint8Array(megabytes * 1e6) }],
});

function page(): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  return store;
}

/** Puts one leader after the other on the page, each at a time of its own; returns them without holding them. */
function load(store: change.Store, times: number, megabytes: number): WeakRef<LoadedLeader>[] {
  return Array.from({ length: times }, () => {
    vi.advanceTimersByTime(2000);
    const loaded = large(megabytes);
    change.apply(store, change.leaderLoaded(loaded));
    return new WeakRef(loaded);
  });
}

/** Indices of those that something still holds. */
async function held(leaders: readonly WeakRef<LoadedLeader>[]): Promise<number[]> {
  setFlagsFromString('--expose_gc');
  const collectGarbage = runInNewContext('gc') as () => void;
  // Weak references hold their objects until the present task ends.
  vi.useRealTimers();
  await new Promise((resolve) => void setTimeout(resolve, 0));
  collectGarbage();
  return leaders.flatMap((leader, index) => (leader.deref() ? [index] : []));
}

function react(store: change.Store, id: string, latents: Float32Array | null = null): void {
  const inputs = currentInputs(store.getState())!;
  const motion = still(inputs.leader.motion.frames);
  const reaction = { motion, latents, inputs, label: null, seconds: 1 };
  change.apply(store, change.reactionAdded(reaction, { id, at: Number(id) * 1e6 }));
}

const steps = (store: change.Store): number => store.getState().history.past.length;

describe('the history of undo', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('frees the oldest steps whose songs, leaders and motions together take too much', async () => {
    const store = page();
    const leaders = load(store, 8, 20);
    // The leader on the page is no part of it; three before it are 60 MB.
    expect(steps(store)).toBe(3);
    leaders.push(...load(store, 8, 20));
    expect(steps(store)).toBe(3);
    expect(await held(leaders)).toEqual([12, 13, 14, 15]);
  });

  it('frees what only undone steps held once something else is done', async () => {
    const store = page();
    const leaders = load(store, 4, 1);
    change.apply(store, undone());
    change.apply(store, undone());
    leaders.push(...load(store, 1, 1));
    expect(await held(leaders)).toEqual([0, 1, 4]);
  });

  it('keeps a hundred small steps, and the last one however large', () => {
    const store = page();
    load(store, 150, 0);
    expect(steps(store)).toBe(100);
    load(store, 1, 200);
    load(store, 1, 0);
    expect(steps(store)).toBe(1);
    change.apply(store, undone());
    expect(store.getState().leader?.files[0]?.bytes).toHaveLength(200e6);
  });

  it('counts the latents of takes that were deleted', () => {
    const store = page();
    load(store, 1, 0);
    for (const id of ['1', '2', '3', '4', '5', '6']) {
      react(store, id, new Float32Array(5e6));
      change.apply(store, takeDeleted(id));
      vi.advanceTimersByTime(2000);
    }
    while (steps(store) > 0) change.apply(store, undone());
    // 60 MB beside the reaction that stays on the stage.
    expect(store.getState().takes.map(({ id }) => id)).toEqual(['6', '5', '4', '3']);
  });

  it('counts what the page holds anyway as nothing', () => {
    const store = page();
    load(store, 1, 200);
    react(store, '1');
    for (let seed = 10; seed < 30; seed++) {
      vi.advanceTimersByTime(2000);
      change.apply(store, change.seedSet(seed));
    }
    expect(steps(store)).toBe(20);
  });

  it('after starting over has that step alone, until a take is made', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(30)));
    react(store, '1');
    change.apply(store, change.seedSet(9));
    change.apply(store, projectCleared(small, 3));
    expect(steps(store)).toBe(1);
    change.apply(store, undone());
    expect(store.getState().takes).toHaveLength(1);
    change.apply(store, redone());
    expect(store.getState().takes).toHaveLength(0);
    change.apply(store, change.firstVisitEnded());
    change.apply(store, change.leaderLoaded(leader(60)));
    react(store, '2');
    change.apply(store, undone());
    change.apply(store, undone());
    expect(store.getState().takes.map(({ id }) => id)).toEqual(['2']);
  });

  it('after starting afresh brings all back although the page has made a reaction by itself', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(30)));
    react(store, '1');
    change.apply(store, projectCleared(small, 3));
    change.apply(store, withoutUndo(change.leaderLoaded(leader(60))));
    react(store, '2');
    change.apply(store, undone());
    expect(store.getState().takes.map(({ id }) => id)).toEqual(['1']);
  });

  it('goes back to the take from before a song and a leader that came together, whatever came between', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(30)));
    react(store, '1');
    expect(steps(store)).toBe(0);
    change.apply(store, change.songLoaded(song(10)));
    react(store, '2');
    change.apply(store, change.leaderLoaded(leader(60)));
    change.apply(store, loadingJoined(null));
    change.apply(store, undone());
    expect(store.getState().song).toBeNull();
    expect(takeOnStage(store.getState())?.id).toBe('1');
  });

  it('ends the reading of a song only where nothing was done since it was asked for', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(30)));
    const cancelled: string[] = [];
    const files = { cancel: (kind: string) => void cancelled.push(kind) };
    ask(store, 'song');
    undoLast(store, files);
    expect(cancelled).toEqual(['song']);
    change.apply(store, change.seedSet(9));
    undoLast(store, files);
    expect(cancelled).toHaveLength(1);
    expect(store.getState().settings?.seed).toBe(7);
  });

  it('takes the preview of a newer reaction off the stage with that reaction', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(30)));
    react(store, '1');
    change.apply(store, change.songLoaded(song(10)));
    react(store, '2');
    change.apply(store, previewShown({ motion: still(30), locked: still(30) }));
    change.apply(store, undone());
    expect(takeOnStage(store.getState())?.id).toBe('1');
    expect(store.getState().preview).toBeNull();
  });

  it('joins the shift of a song with its loading, and no other shift', () => {
    const store = page();
    change.apply(store, change.leaderLoaded(leader(300)));
    change.apply(store, change.songLoaded(song(10)));
    change.apply(store, shiftSet(7));
    change.apply(store, shiftJoined());
    expect(steps(store)).toBe(1);
    change.apply(store, change.seedSet(9));
    change.apply(store, shiftSet(8));
    change.apply(store, shiftJoined());
    expect(steps(store)).toBe(3);
    for (let step = 0; step < 3; step++) change.apply(store, undone());
    expect(store.getState()).toMatchObject({ song: null, shift: 0 });
    change.apply(store, redone());
    expect(store.getState()).toMatchObject({ song: { name: song(10).name }, shift: 7 });
  });
});
