import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Player } from '../../../../web/audio/client';
import { AppError } from '../../../../web/common/error';
import { PlaybackControl } from '../../../../web/ui/timeline/playback';
import * as change from '../../support/actions';
import { regionSet, shiftSet } from '../../../../web/ui/store/actions/timeline';
import { leader, song } from '../../support/made-state';

/** A player whose time the test sets. */
class FakePlayer implements Player {
  time = 0;
  playing = false;
  duration = 0;
  sound: Blob | null = null;
  speed = 1;
  songStart = 0;
  loop: { readonly from: number; readonly to: number } | null = null;
  refusal: Error | null = null;
  onFailure: Player['onFailure'] = null;
  load(sound: Blob | null, duration: number): void {
    Object.assign(this, { sound, duration });
  }
  play(): Promise<void> {
    if (this.refusal) return Promise.reject(this.refusal);
    this.playing = true;
    return Promise.resolve();
  }
  pause(): void {
    this.playing = false;
  }
  seek(seconds: number): void {
    this.time = seconds;
  }
  setSpeed(speed: number): void {
    this.speed = speed;
  }
  setSongStart(seconds: number): void {
    this.songStart = seconds;
  }
  setLoop(loop: FakePlayer['loop']): void {
    this.loop = loop;
  }
}

describe('playback', () => {
  let store: change.Store;
  let player: FakePlayer;
  let playback: PlaybackControl;
  let frames: (() => void)[];

  beforeEach(() => {
    frames = [];
    vi.stubGlobal('requestAnimationFrame', (frame: () => void) => frames.push(frame));
    vi.stubGlobal('cancelAnimationFrame', () => (frames = []));
    store = change.createAppStore('dark');
    player = new FakePlayer();
    playback = new PlaybackControl(store, player);
  });
  afterEach(() => {
    playback.dispose();
    vi.unstubAllGlobals();
  });
  /** Sets the player's time, then draws a frame. */
  const draw = async (time: number): Promise<void> => {
    await Promise.resolve();
    await Promise.resolve();
    player.time = time;
    for (const frame of frames.splice(0)) frame();
  };
  const load = (): void => {
    change.apply(store, change.songLoaded(song(2)));
    change.apply(store, change.leaderLoaded(leader(90)));
  };

  it('plays nothing while nothing is loaded', () => {
    playback.toggle();
    expect(store.getState().playback.playing).toBe(false);
  });

  it('gives the player the song and the length of the dance', () => {
    load();
    expect(player.sound).toBe(store.getState().song?.data.sound);
    expect(player.duration).toBe(3);
  });

  it('follows the player, closes the first-visit block, and stops at the end', async () => {
    load();
    playback.toggle();
    await draw(1.25);
    expect(store.getState()).toMatchObject({ firstVisit: false, playback: { playing: true, time: 1.25 } });
    await draw(3);
    expect(store.getState().playback).toMatchObject({ playing: false, time: 3 });
    expect(player.playing).toBe(false);
  });

  it('follows the player once each frame where it is stopped and started before the player begins', async () => {
    load();
    for (let press = 0; press < 3; press++) playback.toggle();
    await draw(0.5);
    expect(frames).toHaveLength(1);
  });

  it('stops, and says so, where the song fails as it plays', async () => {
    load();
    playback.toggle();
    await draw(0.5);
    player.onFailure?.(
      new AppError('playback-refused', 'The browser did not start the sound.', 'Press play again.'),
    );
    expect(store.getState().playback).toMatchObject({ playing: false, time: 0.5 });
    expect(store.getState().problem?.code).toBe('playback-refused');
    expect(frames).toHaveLength(0);
  });

  it('starts over from the end, by hand or by loop', async () => {
    load();
    playback.seek(3);
    playback.toggle();
    expect(player.time).toBe(0);
    change.apply(store, change.playbackSet({ loop: true }));
    expect(player.loop).toEqual({ from: 0, to: 3 });
    await draw(3);
    expect(store.getState().playback).toMatchObject({ playing: true, time: 3 });
    await draw(0.5);
    expect(store.getState().playback).toMatchObject({ playing: true, time: 0.5 });
  });

  it('loops a region, from whose start it plays at once when the playhead is past it', async () => {
    load();
    playback.toggle();
    await draw(2);
    change.apply(store, regionSet({ from: 0.5, to: 1 }));
    expect(player.loop).toEqual({ from: 0.5, to: 1 });
    expect(player.time).toBe(0.5);
    change.apply(store, regionSet(null));
    expect(player.loop).toBeNull();
  });

  it('plays from the start of the region when the playhead is past it', async () => {
    load();
    change.apply(store, regionSet({ from: 0.5, to: 1 }));
    playback.seek(0.2);
    playback.toggle();
    expect(player.time).toBe(0.2);
    playback.toggle();
    playback.seek(2);
    playback.toggle();
    expect(player.time).toBe(0.5);
    await draw(0.5);
  });

  it('starts the song as much later as it is shifted', () => {
    load();
    change.apply(store, shiftSet(15));
    expect(player.songStart).toBe(0.5);
    change.apply(store, change.songLoaded(song(2)));
    expect(player.songStart).toBe(0);
  });

  it('goes on playing when another song comes', async () => {
    load();
    playback.toggle();
    await draw(1);
    change.apply(store, change.songLoaded(song(5)));
    expect(player.playing).toBe(true);
    expect(player.time).toBe(1);
  });

  it('shows a problem when the browser refuses to play', async () => {
    load();
    player.refusal = new Error('no');
    playback.toggle();
    await draw(0);
    expect(store.getState()).toMatchObject({
      playback: { playing: false },
      problem: { code: 'playback-failed' },
    });
  });

  it('sets the speed of the player', () => {
    change.apply(store, change.playbackSet({ speed: 0.25 }));
    expect(player.speed).toBe(0.25);
  });
});
