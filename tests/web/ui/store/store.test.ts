import { describe, expect, it } from 'vitest';
import * as change from '../../support/actions';
import { projectCleared, projectOpened } from '../../../../web/ui/store/actions/project';
import { undone } from '../../../../web/ui/store/history/history';
import type { Problem } from '../../../../web/ui/store/state';
import { small } from '../../support/small-manifest';
import { uniformGuidance, leader, song, still } from '../../support/made-state';

const ready = (): change.Store => {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  return store;
};

describe('settings', () => {
  it('come from the manifest, with the given seed', () => {
    const store = ready();
    expect(store.getState().settings).toEqual({
      guidance: uniformGuidance(0, 0),
      music: 2,
      variety: 1,
      seed: 7,
      role: 'reactor',
      height: null,
      holdHands: true,
    });
  });

  it('do not exist before the manifest', () => {
    const store = change.createAppStore('dark');
    change.apply(store, change.guidanceSet('coarse', 1));
    change.apply(store, change.seedSet(4));
    expect(store.getState().settings).toBeNull();
  });

  it('clamp guidance to range and step, layer by layer', () => {
    const store = ready();
    change.apply(store, change.guidanceSet('coarse', 9));
    change.apply(store, change.guidanceSet('fine', 0.33));
    expect(store.getState().settings?.guidance).toEqual(uniformGuidance(1, 0.35));
    change.apply(store, change.guidanceReset('coarse'));
    expect(store.getState().settings?.guidance).toEqual(uniformGuidance(0, 0.35));
    change.apply(store, change.guidanceReset());
    expect(store.getState().settings?.guidance).toEqual(uniformGuidance(0, 0));
  });

  it('keep a locked seed when another model comes or the visitor starts afresh, and the role when a model comes', () => {
    const store = ready();
    change.apply(store, change.seedLockSet(true));
    change.apply(store, change.rolesSwapped());
    change.apply(store, change.modelOpened({ ...small, id: 'other' }, 8));
    expect(store.getState().settings).toMatchObject({ seed: 7, role: 'leader' });
    change.apply(store, projectCleared(small, 9));
    expect(store.getState().settings).toMatchObject({ seed: 7, role: 'reactor' });
  });

  it('have a height that is clamped, undone and back in proportion', () => {
    const store = ready();
    change.apply(store, change.leaderLoaded(leader(30)));
    const height = () => store.getState().settings?.height;
    change.apply(store, change.heightSet(1.724));
    expect(height()).toBe(1.724);
    change.apply(store, undone());
    expect(height()).toBeNull();
    change.apply(store, change.heightSet(99));
    expect(height()).toBe(2.5);
    change.apply(store, change.heightSet(NaN));
    expect(height()).toBe(2.5);
    change.apply(store, change.heightSet(null));
    expect(height()).toBeNull();
  });

  it('clamp the variety to its own range, and reset it with the rest', () => {
    const store = ready();
    const variety = () => store.getState().settings?.variety;
    change.apply(store, change.varietySet(9));
    expect(variety()).toBe(2);
    change.apply(store, change.varietySet(0.52));
    expect(variety()).toBe(0.5);
    change.apply(store, change.varietyReset());
    expect(variety()).toBe(1);
    change.apply(store, change.varietySet(0));
    change.apply(store, change.guidanceReset());
    expect(variety()).toBe(1);
  });

  it('clamp the guidance of the music to its own range, and reset it with the rest', () => {
    const store = ready();
    const music = () => store.getState().settings?.music;
    change.apply(store, change.musicSet(9));
    expect(music()).toBe(4);
    change.apply(store, change.musicSet(1.23));
    expect(music()).toBe(1.25);
    change.apply(store, change.musicReset());
    expect(music()).toBe(2);
    change.apply(store, change.musicSet(0));
    change.apply(store, change.guidanceSet('fine', 1));
    expect(music()).toBe(0);
    change.apply(store, change.guidanceReset());
    expect(store.getState().settings).toMatchObject({ guidance: uniformGuidance(0, 0), music: 2 });
    const preset = { guidance: uniformGuidance(1, 0.5), music: 0, variety: 1.5 };
    change.apply(store, change.presetChosen(preset));
    expect(store.getState().settings).toMatchObject(preset);
  });

  it('are the same object while nothing changes, so that nothing is generated again', () => {
    const store = ready();
    const before = store.getState().settings;
    change.apply(store, change.guidanceSet('coarse', 0.01));
    change.apply(store, change.musicSet(2.01));
    change.apply(store, change.guidanceReset());
    expect(store.getState().settings).toBe(before);
  });

  it('clamp the seed to the range of the model', () => {
    const store = ready();
    const seed = () => store.getState().settings?.seed;
    change.apply(store, change.seedSet(-3));
    expect(seed()).toBe(0);
    change.apply(store, change.seedSet(2 ** 40));
    expect(seed()).toBe(0xffffffff);
    change.apply(store, change.seedSet(Number.NaN));
    expect(seed()).toBe(0xffffffff);
  });
});

describe('files', () => {
  it('a new leader takes the old reaction off the stage and starts over', () => {
    const store = ready();
    const first = leader(300);
    change.apply(store, change.leaderLoaded(first));
    const { settings } = store.getState();
    if (!settings) throw new Error('no settings');
    change.apply(
      store,
      change.reactionAdded({
        motion: still(300),
        latents: null,
        inputs: { leader: first, song: null, shift: 0, settings },
        label: null,
        seconds: 1,
      }),
    );
    change.apply(store, change.playbackSet({ time: 5, playing: true }));
    change.apply(store, change.leaderLoaded(leader(90)));
    expect(store.getState()).toMatchObject({ reaction: null, playback: { time: 0, playing: false } });
  });

  it('a new song leaves the reaction on the stage until the next one is ready', () => {
    const store = ready();
    const first = leader(300);
    change.apply(store, change.leaderLoaded(first));
    const { settings } = store.getState();
    if (!settings) throw new Error('no settings');
    const reaction = {
      motion: still(300),
      latents: null,
      inputs: { leader: first, song: null, shift: 0, settings },
      label: null,
      seconds: 1,
    };
    change.apply(store, change.reactionAdded(reaction));
    change.apply(store, change.readingSet('song', { name: 'a.mp3', fraction: 0.5 }));
    change.apply(store, change.songLoaded(song(5)));
    expect(store.getState().reaction).toBe(reaction);
    expect(store.getState().reading.song).toBeNull();
  });
});

describe('playing', () => {
  it('stays inside the dance, whose length is the leader’s', () => {
    const store = ready();
    change.apply(store, change.songLoaded(song(20)));
    change.apply(store, change.playbackSet({ time: 99 }));
    expect(store.getState().playback.time).toBe(20);
    change.apply(store, change.leaderLoaded(leader(150)));
    change.apply(store, change.playbackSet({ time: 99 }));
    expect(store.getState().playback.time).toBe(5);
    change.apply(store, change.playbackSet({ time: -1 }));
    expect(store.getState().playback.time).toBe(0);
  });

  it('moves the playhead to the end of a shorter song where there is no leader', () => {
    const store = ready();
    change.apply(store, change.songLoaded(song(30)));
    change.apply(store, change.playbackSet({ time: 20 }));
    change.apply(store, change.songLoaded(song(10)));
    expect(store.getState().playback.time).toBe(10);
  });

  it('opens one floating panel at a time and closes it by the same button', () => {
    const store = ready();
    change.apply(store, change.panelToggled('download'));
    change.apply(store, change.panelToggled('keys'));
    expect(store.getState().openPanel).toBe('keys');
    change.apply(store, change.panelToggled('keys'));
    expect(store.getState().openPanel).toBeNull();
  });

  it('shows failures one after the other, each once', () => {
    const store = ready();
    const problem = (code: string): Problem => ({
      code,
      title: code,
      hint: '',
      remedy: 'none',
      refused: null,
    });
    change.apply(store, change.problemShown(problem('first')));
    change.apply(store, change.problemShown(problem('second')));
    change.apply(store, change.problemShown(problem('first')));
    change.apply(store, change.problemShown(problem('second')));
    expect(store.getState().problem?.code).toBe('first');
    change.apply(store, change.problemClosed());
    expect(store.getState().problem?.code).toBe('second');
    change.apply(store, change.problemClosed());
    expect(store.getState()).toMatchObject({ problem: null, queuedProblems: [] });
  });

  it('forgets the notices on work that is cleared or replaced by a project, until that is undone', () => {
    const store = ready();
    change.apply(store, change.leaderLoaded(leader(30)));
    change.apply(store, change.noticeAdded('A take was damaged.'));
    for (const replaced of [projectCleared(small, 9), projectOpened({ leader: leader(60) })]) {
      change.apply(store, replaced);
      expect(store.getState().notices).toEqual([]);
      change.apply(store, undone());
      expect(store.getState().notices).toEqual(['A take was damaged.']);
    }
  });

  it('adds a notice once', () => {
    const store = ready();
    change.apply(store, change.noticeAdded('The storage is full.'));
    change.apply(store, change.noticeAdded('The storage is full.'));
    expect(store.getState().notices).toEqual(['The storage is full.']);
  });
});

describe('watching', () => {
  it('calls at once and then only when the selected value changes', () => {
    const store = ready();
    const seen: number[] = [];
    const stop = change.watch(
      store,
      (state) => state.playback.speed,
      (speed) => {
        seen.push(speed);
      },
    );
    change.apply(store, change.themeSet('light'));
    change.apply(store, change.playbackSet({ speed: 2 }));
    stop();
    change.apply(store, change.playbackSet({ speed: 0.5 }));
    expect(seen).toEqual([1, 2]);
  });
});
