import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import {
  modelIdentity,
  type LoadedLeader,
  type Reaction,
  type Settings,
} from '../../../../web/ui/store/reaction';
import type { AppState } from '../../../../web/ui/store/state';
import { columnOf } from '../../../../web/ui/store/guidance-matrix';
import * as change from '../../support/actions';
import { regionSet, shiftSet, zoomSet } from '../../../../web/ui/store/actions/timeline';
import { MAX_TAKES } from '../../../../web/ui/store/add-take';
import { takesMerged } from '../../../../web/ui/store/actions/project';
import * as edit from '../../../../web/ui/store/actions/takes';
import { redone, undone, withoutUndo } from '../../../../web/ui/store/history/history';
import { type OtherDancer, showOther } from '../../../../web/ui/takes/other-dancer';
import { letterOf, currentInputs, takeOnStage, takeTitle } from '../../../../web/ui/store/take';
import { retrained, small } from '../../support/small-manifest';
import { leader, song, still } from '../../support/made-state';

/** A page on which reactions arrive by hand. */
class Page {
  readonly store = change.createAppStore('dark');
  now = 1_000_000;
  private made = 0;

  constructor(readonly dancer: LoadedLeader = leader(300)) {
    change.apply(this.store, change.manifestLoaded(small, 7));
    change.apply(this.store, change.leaderLoaded(dancer));
  }

  get state(): AppState {
    return this.store.getState();
  }
  get titles(): string[] {
    return this.state.takes.map(takeTitle);
  }
  get onStage(): string | undefined {
    const take = takeOnStage(this.state);
    return take ? takeTitle(take) : undefined;
  }
  get coarse(): number | undefined {
    const { settings } = this.state;
    return settings ? columnOf(settings.guidance, 'coarse').value : undefined;
  }
  do(...changes: change.Change[]): void {
    for (const one of changes) change.apply(this.store, one);
  }
  /** The reaction to what is asked for now arrives. */
  arrive({ label = null, after = 60_000 }: { label?: string | null; after?: number } = {}): Reaction {
    const inputs = currentInputs(this.state);
    if (!inputs) throw new Error('nothing to react to');
    this.now += after;
    const frames = inputs.leader.motion.frames;
    const reaction = {
      motion: still(frames),
      latents: null,
      model: modelIdentity(this.state.manifest!),
      inputs,
      label,
      seconds: label === null ? 1 : null,
    };
    this.do(change.reactionAdded(reaction, { id: `id-${++this.made}`, at: this.now }));
    return reaction;
  }
  id(title: string): string {
    const take = this.state.takes.find((one) => takeTitle(one) === title);
    if (!take) throw new Error(`no take ${title} among ${this.titles.join(', ')}`);
    return take.id;
  }
  seed(seed: number): void {
    this.do(change.seedSet(seed));
  }
}

let page: Page;
beforeEach(() => {
  page = new Page();
});

describe('a new reaction', () => {
  it('becomes a take with its inputs, the newest first', () => {
    const first = page.arrive();
    page.seed(8);
    const second = page.arrive();
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    expect(page.state.takes.map(({ reaction }) => reaction)).toEqual([second, first]);
    expect(page.onStage).toBe('Take 2');
    expect(page.state.takes[0]).toMatchObject({ starred: false, name: null, createdAt: page.now });
  });

  it('is named by its label when it came ready-made, and gets no number', () => {
    page.arrive({ label: 'demo reaction' });
    page.seed(8);
    page.arrive();
    expect(page.titles).toEqual(['Take 1', 'Demo reaction']);
  });

  it('is completed by its song, on the stage and in the list', () => {
    const before = page.arrive({ label: 'demo reaction' });
    page.do(withoutUndo(change.songLoaded(song(10))));
    const complete = { ...before, inputs: { ...before.inputs, song: page.state.song } };
    page.do(change.reactionCompleted(complete));
    expect(page.titles).toEqual(['Demo reaction']);
    expect(takeOnStage(page.state)?.reaction).toBe(complete);
    expect(page.state.history.past).toEqual([]);
  });

  it('is the same take when the inputs are the same', () => {
    page.arrive();
    page.seed(8);
    page.arrive();
    page.seed(7);
    page.arrive();
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    expect(page.onStage).toBe('Take 1');
  });
});

describe('a reaction of another model', () => {
  it('leaves the take that the model before made from the same inputs', () => {
    const before = page.arrive();
    page.do(change.modelOpened(retrained(), 3));
    page.seed(7);
    const other = page.arrive({ after: 1000 });
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    expect(page.state.takes.map(({ reaction }) => reaction.motion)).toEqual([other.motion, before.motion]);
    page.do(edit.takeChosen(page.id('Take 1')));
    page.arrive();
    expect([page.titles, page.onStage]).toEqual([['Take 2', 'Take 1'], 'Take 2']);
  });

  it('replaces no take of the model before that differs in weights, however soon it comes', () => {
    page.arrive();
    page.do(change.modelOpened(retrained(), 7), change.guidanceSet('coarse', 0.5));
    page.arrive({ after: 1000 });
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    page.do(change.guidanceSet('coarse', 0.6));
    page.arrive({ after: 1000 });
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
  });
});

describe('a drag of guidance', () => {
  const drag = (...values: number[]): void => {
    for (const value of values) {
      page.do(change.guidanceSet('coarse', value));
      page.arrive({ after: 300 });
    }
  };
  const beginAtRest = (): void => {
    page.arrive();
    page.now += 60_000;
  };

  it('leaves one take, the last', () => {
    beginAtRest();
    drag(0.5, 0.6, 0.7);
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    expect(page.state.takes[0]?.reaction.inputs.settings.guidance.lower?.coarse).toBe(0.7);
    page.now += 10_000;
    drag(0.8);
    expect(page.titles).toEqual(['Take 3', 'Take 2', 'Take 1']);
  });

  it('leaves a take that is from later than now, of a computer whose clock is ahead', () => {
    beginAtRest();
    page.now -= 3_600_000;
    drag(0.5);
    expect(page.state.takes).toHaveLength(2);
  });

  it.each<[string, (id: string) => change.Change]>([
    ['starred', edit.takeStarred],
    ['named', (id) => edit.takeRenamed(id, 'Mine')],
  ])('leaves a take that was %s as it is', (_, mark) => {
    beginAtRest();
    drag(0.5);
    page.do(mark(page.state.takes[0]?.id ?? ''));
    drag(0.6);
    expect(page.state.takes).toHaveLength(3);
  });

  it('leaves a take that is compared as it is', () => {
    beginAtRest();
    drag(0.5);
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.takesSwapped());
    // Take 1 is on the stage now and takes the drag up; Take 2 is what it is compared with.
    page.do(change.guidanceSet('coarse', 0.55));
    page.arrive({ after: 300 });
    expect(page.state.takes).toHaveLength(3);
    page.do(change.guidanceSet('coarse', 0.6));
    page.arrive({ after: 300 });
    expect(page.state.takes).toHaveLength(3);
    expect(page.id('Take 2')).toBe(page.state.other);
  });

  it('does not replace another seed, a ready-made reaction or another leader', () => {
    page.arrive({ label: 'demo reaction' });
    drag(0.5);
    page.seed(9);
    page.arrive({ after: 300 });
    expect(page.titles).toEqual(['Take 2', 'Take 1', 'Demo reaction']);
    page.do(change.leaderLoaded(leader(90, 'other.bvh')));
    page.arrive({ after: 300 });
    expect(page.titles).toHaveLength(4);
  });

  it('is one step of undo, however many reactions came, and the last can be restored', () => {
    beginAtRest();
    drag(0.5, 0.6, 0.7);
    page.do(undone());
    expect([page.coarse, page.onStage]).toEqual([0, 'Take 1']);
    expect(page.state.history.past).toHaveLength(0);
    page.do(redone());
    expect([page.coarse, page.onStage]).toEqual([0.7, 'Take 2']);
  });
});

describe('a drag with the pointer', () => {
  beforeEach(() => {
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });
  const move = (value: number, after: number): void => {
    page.do(change.guidanceSet('coarse', value));
    page.arrive({ after });
    vi.advanceTimersByTime(after);
  };
  const steps = (): number => page.state.history.past.length;

  it('makes one take and one step of undo, however long the hand rests', () => {
    page.arrive();
    page.now += 60_000;
    page.do(change.dragBegun());
    for (const value of [0.1, 0.2, 0.3]) move(value, 10_000);
    page.do(change.guidanceSet('coarse', 0.4), change.dragEnded());
    // The last reaction comes after the release.
    page.arrive({ after: 10_000 });
    expect([page.titles, page.coarse, steps()]).toEqual([['Take 2', 'Take 1'], 0.4, 1]);
    page.do(undone());
    expect([page.onStage, page.coarse]).toEqual(['Take 1', 0]);
  });

  it('is one step of undo with that of another fader by a second finger', () => {
    page.arrive();
    page.now += 60_000;
    page.do(change.dragBegun());
    for (const value of [0.2, 0.4, 0.6]) page.do(change.guidanceSet('coarse', value), change.musicSet(value));
    page.do(change.dragEnded());
    expect(steps()).toBe(1);
    page.do(undone());
    expect(page.coarse).toBe(0);
  });

  it('of a double click, whose first click moved the fader, is one step of undo with its reset', () => {
    page.do(change.guidanceSet('coarse', 1));
    vi.advanceTimersByTime(5000);
    page.do(change.dragBegun(), change.guidanceSet('coarse', 0.4), change.dragEnded());
    vi.advanceTimersByTime(200);
    page.do(change.dragBegun(), change.dragEnded(), change.clickContinued(), change.guidanceReset('coarse'));
    expect([page.coarse, steps()]).toEqual([0, 2]);
    page.do(undone());
    expect(page.coarse).toBe(1);
  });

  it('that ends where it began is no step of undo, nor is a double click on a fader at its default', () => {
    page.arrive();
    page.do(change.musicSet(1));
    page.do(change.dragBegun());
    for (const value of [0.2, 0, 0.4, 0]) page.do(change.guidanceSet('coarse', value));
    page.do(change.dragEnded());
    expect(steps()).toBe(1);
    page.do(change.dragBegun(), change.guidanceSet('coarse', 0.4), change.dragEnded());
    page.do(change.dragBegun(), change.dragEnded(), change.clickContinued(), change.guidanceReset('coarse'));
    expect([page.coarse, steps()]).toEqual([0, 1]);
    page.do(change.dragBegun(), change.guidanceSet('coarse', 0.4), change.dragEnded(), undone());
    expect([page.coarse, page.state.settings?.music, steps()]).toEqual([0, 1, 1]);
  });

  it('leaves the take of the drag before, however soon it follows', () => {
    page.arrive();
    page.now += 60_000;
    for (const value of [0.1, 0.2]) {
      page.do(change.dragBegun());
      move(value, 100);
      page.do(change.dragEnded());
    }
    expect([page.titles, steps()]).toEqual([['Take 3', 'Take 2', 'Take 1'], 2]);
    expect(page.state.drag).toBeNull();
  });

  it('makes one take where a reaction to the way there comes after the release, however late the last one is', () => {
    page.arrive();
    page.now += 60_000;
    page.do(change.dragBegun(), change.guidanceSet('coarse', 0.3));
    const onTheWay = currentInputs(page.state)!;
    page.do(change.guidanceSet('coarse', 0.4), change.dragEnded());
    const { motion } = page.state.reaction!;
    const late = { ...page.state.reaction!, motion: still(motion.frames), inputs: onTheWay };
    page.do(change.reactionAdded(late, { id: 'late', at: page.now }));
    page.arrive({ after: 10_000 });
    expect([page.titles, page.coarse, page.state.drag]).toEqual([['Take 2', 'Take 1'], 0.4, null]);
  });

  it('that passes the settings of an older take leaves that take as it is', () => {
    const first = page.arrive();
    page.now += 60_000;
    page.do(change.dragBegun());
    for (const value of [0.1, 0, 0.2]) move(value, 100);
    page.do(change.dragEnded());
    expect(page.titles).toEqual(['Take 3', 'Take 1']);
    expect(page.state.takes.at(-1)?.reaction.inputs).toEqual(first.inputs);
  });
});

describe('clearing takes', () => {
  const seeds = (...values: number[]): void => {
    for (const seed of values) {
      page.seed(seed);
      page.arrive();
    }
  };

  it('keeps the starred ones, shows the newest of them, says how many left, and is one step of undo', () => {
    seeds(1, 2, 3, 4);
    for (const title of ['Take 1', 'Take 2']) page.do(edit.takeStarred(page.id(title)));
    page.do(edit.letterGiven(page.id('Take 3'), 'B'), edit.starredKept());
    expect([page.titles, page.onStage, page.state.other]).toEqual([['Take 2', 'Take 1'], 'Take 2', null]);
    expect(page.state.toast?.text).toMatch(/^2 takes without a star/);
    expect(edit.hasTakesToClear(page.state)).toBe(false);
    page.do(undone());
    expect([page.titles.length, page.onStage]).toEqual([4, 'Take 4']);
  });

  it('does nothing without a star, and keeps the stage where no starred take is to its leader', () => {
    seeds(1, 2);
    page.do(edit.starredKept());
    expect(page.titles).toHaveLength(2);
    page.do(edit.takeStarred(page.id('Take 1')), change.leaderLoaded(leader(90, 'other.bvh')));
    page.arrive();
    page.do(edit.starredKept());
    expect([page.titles, page.onStage]).toEqual([['Take 3', 'Take 1'], 'Take 3']);
  });
});

describe('the limit of takes', () => {
  it('removes the oldest, unless they are starred, named or in use', () => {
    page.arrive();
    page.do(edit.takeStarred(page.id('Take 1')));
    for (let seed = 100; seed < 100 + MAX_TAKES + 3; seed++) {
      page.seed(seed);
      page.arrive();
      if (seed === 100) page.do(edit.takeRenamed(page.id('Take 2'), 'Mine'));
      if (seed === 101) page.do(edit.letterGiven(page.id('Mine'), 'B'));
    }
    expect(page.titles).toHaveLength(MAX_TAKES);
    expect(page.titles.slice(-3)).toEqual(['Take 7', 'Mine', 'Take 1']);
    expect(page.state.toast?.text).toMatch(/^“Take 6” left the list, which holds 40 takes/);
  });
});

describe('choosing a take', () => {
  it('shows it at the same playhead with files and settings as they were, so that nothing is generated again', () => {
    const first = page.arrive();
    page.do(change.songLoaded(song(10)));
    page.seed(8);
    page.arrive();
    page.do(change.playbackSet({ time: 4 }));
    page.do(edit.takeChosen(page.id('Take 1')));
    expect(page.state.reaction).toBe(first);
    expect(currentInputs(page.state)).toEqual(first.inputs);
    expect(page.state.song).toBeNull();
    expect(page.state.playback.time).toBe(4);
  });

  it('brings its own leader, and a playhead inside its dance', () => {
    page.arrive();
    page.do(change.leaderLoaded(leader(600, 'long.bvh')));
    page.arrive();
    page.do(change.playbackSet({ time: 18 }), edit.takeChosen(page.id('Take 1')));
    expect(page.state.leader).toBe(page.dancer);
    expect(page.state.playback.time).toBe(10);
    page.do(undone());
    expect([page.state.leader?.name, page.onStage]).toEqual(['long.bvh', 'Take 2']);
  });

  it('to a shorter leader shows all of its dance and ends a loop beyond it, as does undo', () => {
    const inLong = (): void => {
      page.do(
        regionSet({ from: 12, to: 15 }),
        zoomSet({ from: 11, to: 16 }),
        change.playbackSet({ time: 13 }),
      );
    };
    page.arrive();
    page.do(change.leaderLoaded(leader(600, 'long.bvh')));
    page.arrive();
    inLong();
    page.do(edit.takeChosen(page.id('Take 1')));
    expect(page.state).toMatchObject({ zoom: null, playback: { time: 10, region: null } });
    page.do(undone());
    inLong();
    page.do(redone());
    expect(page.state.leader).toBe(page.dancer);
    expect(page.state).toMatchObject({ zoom: null, playback: { time: 10, region: null } });
  });

  it('of another song soon after one of the same song is undone with its song', () => {
    page.do(change.songLoaded(song(10)));
    page.arrive();
    page.seed(8);
    page.arrive();
    page.do(change.songLoaded(song(12)), shiftSet(5));
    page.arrive();
    page.do(edit.takeChosen(page.id('Take 1')));
    vi.useFakeTimers({ now: Date.now() + 5000 });
    const { reaction, song: before } = page.state;
    page.do(edit.takeChosen(page.id('Take 2')), edit.takeChosen(page.id('Take 3')));
    page.do(undone());
    expect(page.state.reaction).toBe(reaction);
    expect(page.state.song).toBe(before);
    expect(currentInputs(page.state)).toEqual(reaction!.inputs);
    page.do(redone());
    expect([page.onStage, page.state.shift]).toEqual(['Take 3', 5]);
  });

  it('of the same leader leaves loop and zoom as they are', () => {
    page.arrive();
    page.seed(8);
    page.arrive();
    page.do(regionSet({ from: 2, to: 5 }), zoomSet({ from: 1, to: 6 }));
    const { playback, zoom } = page.state;
    page.do(edit.takeChosen(page.id('Take 1')));
    expect(page.state.playback).toBe(playback);
    page.do(undone());
    expect(page.state).toMatchObject({ zoom, playback });
  });
});

describe('A and B', () => {
  const letters = (): string =>
    page.state.takes.map((take) => `${takeTitle(take)} ${letterOf(take, page.state) ?? '-'}`).join(', ');
  beforeEach(() => {
    for (const seed of [1, 2, 3]) {
      page.seed(seed);
      page.arrive();
    }
  });

  it('swap on the stage and stay with their takes', () => {
    page.do(edit.letterGiven(page.id('Take 1'), 'B'));
    expect(letters()).toBe('Take 3 A, Take 2 -, Take 1 B');
    page.do(edit.takesSwapped());
    expect([page.onStage, letters()]).toEqual(['Take 1', 'Take 3 A, Take 2 -, Take 1 B']);
    expect(page.state.settings?.seed).toBe(1);
    page.do(edit.takesSwapped());
    expect([page.onStage, letters()]).toEqual(['Take 3', 'Take 3 A, Take 2 -, Take 1 B']);
  });

  it('swap without a step of undo', () => {
    page.do(edit.letterGiven(page.id('Take 1'), 'B'));
    const { history } = page.state;
    page.do(edit.takesSwapped(), edit.takesSwapped());
    expect(page.state.history).toBe(history);
  });

  it('without a B, B is the newest other take', () => {
    page.do(edit.takesSwapped());
    expect(letters()).toBe('Take 3 A, Take 2 B, Take 1 -');
    expect(page.onStage).toBe('Take 2');
  });

  it('go to the take that is given them, and change places with each other', () => {
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.letterGiven(page.id('Take 1'), 'A'));
    expect([letters(), page.onStage]).toEqual(['Take 3 B, Take 2 -, Take 1 A', 'Take 1']);
    page.do(edit.letterGiven(page.id('Take 1'), 'B'));
    expect([letters(), page.onStage]).toEqual(['Take 3 A, Take 2 -, Take 1 B', 'Take 1']);
    page.do(edit.letterGiven(page.id('Take 2'), 'B'));
    expect([letters(), page.onStage]).toEqual(['Take 3 A, Take 2 B, Take 1 -', 'Take 2']);
    page.do(edit.letterGiven(page.id('Take 3'), 'A'));
    // Without a comparison the one on the stage is A.
    expect(letters()).toBe('Take 3 -, Take 2 A, Take 1 -');
    page.do(edit.letterGiven(page.id('Take 1'), 'B'));
    expect(letters()).toBe('Take 3 -, Take 2 A, Take 1 B');
  });

  it('are shown together only while both exist', () => {
    page.do(edit.compareSet('ghost'));
    expect(page.state.compare).toBe('off');
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.compareSet('side'), edit.compareSet('ghost'));
    expect(page.state.compare).toBe('ghost');
    page.do(edit.compareSet('ghost'));
    expect(page.state.compare).toBe('off');
    page.do(edit.compareSet('side'), edit.takeDeleted(page.id('Take 1')));
    expect([page.state.other, page.state.compare]).toEqual([null, 'off']);
    page.do(undone());
    expect([page.state.compare, letters()]).toEqual(['side', 'Take 3 A, Take 2 -, Take 1 B']);
  });

  it('are given both at once: the take that gets B leaves A to the newest other one', () => {
    page.do(edit.letterGiven(page.id('Take 3'), 'A'));
    expect(letters()).toBe('Take 3 A, Take 2 -, Take 1 -');
    page.do(edit.letterGiven(page.id('Take 3'), 'B'));
    expect([letters(), page.onStage]).toEqual(['Take 3 B, Take 2 A, Take 1 -', 'Take 3']);
  });

  it('have A on the left and B on the right, whichever is on the stage', () => {
    let seen: OtherDancer | null = null;
    const stop = showOther(page.store, { setOther: (other) => (seen = other) });
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.compareSet('side'));
    const labels = { left: 'A Take 3', right: 'B Take 1' };
    expect(seen).toMatchObject({ mode: 'right', labels });
    page.do(edit.takesSwapped());
    expect(seen).toMatchObject({ mode: 'left', labels });
    page.do(edit.compareSet('ghost'));
    expect(seen).toMatchObject({ mode: 'ghost' });
    stop();
  });

  it('do not compare a leader with a reactor', () => {
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.compareSet('side'), change.rolesSwapped());
    expect([page.state.other, page.state.compare]).toEqual([null, 'off']);
    page.arrive();
    const [take] = page.state.takes.filter(({ id }) => id === page.id('Take 1'));
    expect(edit.whyNoLetter(take!, 'B', page.state)).toBe('This take dances the other role.');
    page.do(edit.letterGiven(page.id('Take 1'), 'B'));
    expect(page.state.other).toBeNull();
    const [alone] = page.state.takes.filter(({ id }) => id === page.id('Take 4'));
    expect(edit.whyNoLetter(alone!, 'B', page.state)).toBe('There is no other take to compare with.');
  });

  it('are not drawn while another leader is there', () => {
    let seen: OtherDancer | null = null;
    const stop = showOther(page.store, { setOther: (other) => (seen = other) });
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.compareSet('side'));
    page.do(change.leaderLoaded(leader(90, 'other.bvh')));
    expect(seen).toBeNull();
    page.arrive();
    expect([seen, letters()]).toEqual([null, 'Take 4 A, Take 3 -, Take 2 -, Take 1 -']);
    page.do(undone());
    expect(seen).toMatchObject({ labels: { left: 'A Take 3', right: 'B Take 1' } });
    stop();
  });

  it('are two takes, also after undoing leads to the one that was the other', () => {
    page.do(edit.letterGiven(page.id('Take 2'), 'B'), edit.compareSet('side'), undone());
    expect([page.onStage, letters()]).toEqual(['Take 2', 'Take 3 -, Take 2 A, Take 1 -']);
    page.do(edit.takeChosen(page.id('Take 1')));
    expect([page.state.compare, letters()]).toEqual(['off', 'Take 3 -, Take 2 -, Take 1 A']);
  });

  it('end when the compared take is shown itself', () => {
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), change.leaderLoaded(leader(90, 'other.bvh')));
    page.arrive();
    page.do(edit.takeChosen(page.id('Take 1')), edit.takeChosen(page.id('Take 2')));
    expect(letters()).toBe('Take 4 -, Take 3 -, Take 2 A, Take 1 -');
  });

  it('do not compare dances to different leaders', () => {
    page.do(change.leaderLoaded(leader(90, 'other.bvh')));
    page.arrive();
    page.do(edit.letterGiven(page.id('Take 1'), 'B'), edit.takesSwapped());
    expect([page.state.other, page.onStage]).toEqual([null, 'Take 4']);
  });
});

describe('undo and redo', () => {
  beforeEach(() => {
    page.arrive();
    page.seed(8);
    page.arrive();
  });

  it('restore names, stars and deleted takes', () => {
    page.do(edit.takeRenamed(page.id('Take 1'), '  Softer   hands '));
    page.do(edit.takeStarred(page.id('Softer hands')));
    page.do(edit.takeDeleted(page.id('Softer hands')));
    expect(page.titles).toEqual(['Take 2']);
    page.do(undone());
    expect(page.state.takes[1]).toMatchObject({ name: 'Softer hands', starred: true });
    page.do(undone());
    expect(page.state.takes[1]).toMatchObject({ name: 'Softer hands', starred: false });
    page.do(undone());
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    page.do(redone(), redone(), redone());
    expect(page.titles).toEqual(['Take 2']);
    expect(page.state.history.future).toHaveLength(0);
  });

  it('show the take before and leave the new one in the list', () => {
    page.do(undone());
    expect([page.onStage, page.state.settings?.seed]).toEqual(['Take 1', 7]);
    expect(page.titles).toEqual(['Take 2', 'Take 1']);
    page.do(redone());
    expect([page.onStage, page.state.settings?.seed]).toEqual(['Take 2', 8]);
  });

  it('keep takes that are newer than what is undone', () => {
    page.do(edit.takeDeleted(page.id('Take 1')));
    page.seed(9);
    page.arrive();
    page.do(undone(), undone());
    expect(page.titles).toEqual(['Take 3', 'Take 2', 'Take 1']);
  });

  it('deleting the take on the stage shows the next one; the last leaves the stage as it is', () => {
    page.do(edit.takeDeleted(page.id('Take 2')));
    expect([page.onStage, page.state.settings?.seed]).toEqual(['Take 1', 7]);
    const { reaction } = page.state;
    page.do(edit.takeDeleted(page.id('Take 1')));
    expect(page.state.takes).toEqual([]);
    expect(page.state.reaction).toBe(reaction);
    page.do(undone(), undone());
    expect([page.onStage, page.titles]).toEqual(['Take 2', ['Take 2', 'Take 1']]);
  });

  it('restore a take that a later reaction of the drag has replaced', () => {
    page.do(change.guidanceSet('fine', 0.5));
    const kept = page.arrive();
    // A step of its own, but within the time of folding.
    page.do((state) => ({ history: { ...state.history, open: false } }));
    page.do(change.guidanceSet('fine', 1));
    page.arrive({ after: 2000 });
    expect(page.titles).toEqual(['Take 3', 'Take 2', 'Take 1']);
    page.do(undone());
    expect(page.state.reaction).toBe(kept);
    expect([page.onStage, page.state.takes.length]).toEqual(['Take 3', 3]);
    page.do(redone());
    expect(takeOnStage(page.state)?.reaction.inputs.settings.guidance.lower?.fine).toBe(1);
  });

  it('a new change removes what could be redone; an equal value is no change', () => {
    page.do(undone());
    const settings = { ...(page.state.settings as Settings) };
    page.do(change.settingsSet(settings));
    expect(page.state.history.future).toHaveLength(1);
    page.do(change.seedSet(settings.seed + 1));
    expect(page.state.history.future).toHaveLength(0);
  });

  it('restore the leader and the reaction before another leader was dropped', () => {
    page.do(change.leaderLoaded(leader(90, 'other.bvh')));
    expect(page.state.reaction).toBeNull();
    page.do(undone());
    expect([page.state.leader, page.onStage]).toEqual([page.dancer, 'Take 2']);
  });

  it('do not include what the page does by itself', () => {
    const fresh = new Page();
    fresh.do(withoutUndo(change.songLoaded(song(10))), change.playbackSet({ time: 3 }));
    fresh.arrive();
    expect(fresh.state.history.past).toEqual([]);
  });
});

it('merges takes with those another tab has stored: what was changed or deleted here stays so, the rest is theirs', () => {
  for (const seed of [8, 9, 10]) {
    page.arrive();
    page.seed(seed);
  }
  page.arrive();
  const synced = page.state.takes;
  const renamed = (title: string, name: string) =>
    synced.map((take) => (takeTitle(take) === title ? { ...take, name } : take));
  page.do(edit.takeRenamed(page.id('Take 1'), 'Mine'), edit.takeDeleted(page.id('Take 2')));
  const theirs = [
    ...renamed('Take 3', 'Theirs').filter((take) => takeTitle(take) !== 'Take 4'),
    { ...synced[0]!, id: 'new', number: 5, createdAt: page.now + 1 },
  ];
  page.do(takesMerged(theirs, synced));
  expect(page.titles).toEqual(['Take 5', 'Theirs', 'Mine']);
  expect(page.state.takesMade).toBe(5);
});

it('merged takes of two tabs that counted alike get numbers of their own, the older one keeps its', () => {
  page.arrive();
  const synced = page.state.takes;
  page.seed(8);
  page.arrive();
  const [here, first] = page.state.takes;
  const theirs = [
    { ...here!, id: 'newer', createdAt: here!.createdAt + 1 },
    { ...here!, id: 'older', createdAt: here!.createdAt - 1 },
    first!,
  ];
  page.do(takesMerged(theirs, synced));
  expect(page.state.takes.map(({ id, number }) => [id, number])).toEqual([
    ['newer', 4],
    [here!.id, 3],
    ['older', 2],
    [first!.id, 1],
  ]);
  expect(page.state.takesMade).toBe(4);
});

it('merged reactions of the page, which have no number, get none', () => {
  page.arrive({ label: 'demo reaction' });
  const [here] = page.state.takes;
  page.do(takesMerged([{ ...here!, id: 'of the other tab', createdAt: here!.createdAt - 1 }], []));
  expect(page.state.takes.map(({ number }) => number)).toEqual([0, 0]);
  page.seed(8);
  page.arrive();
  expect(page.onStage).toBe('Take 1');
});
