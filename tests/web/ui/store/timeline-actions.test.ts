import { beforeEach, describe, expect, it } from 'vitest';
import * as store from '../../support/actions';
import * as shift from '../../../../web/ui/store/song-shift';
import * as change from '../../../../web/ui/store/actions/timeline';
import { readyInputs, sameInputs } from '../../../../web/ui/store/selectors';
import { small } from '../../support/small-manifest';
import { leader, rhythm, song } from '../../support/made-state';

describe('timeline changes', () => {
  let page: store.Store;
  const does = (what: store.Change): void => store.apply(page, what);
  const now = () => page.getState();

  beforeEach(() => {
    page = store.createAppStore('dark');
    does(store.manifestLoaded(small, 7));
    does(store.leaderLoaded(leader(300)));
    does(store.songLoaded(song(6)));
  });

  it('a region is in order, inside the dance, not too short, and loops', () => {
    does(change.regionSet({ from: 7, to: 2 }));
    expect(now().playback).toMatchObject({ region: { from: 2, to: 7 }, loop: true });
    does(change.regionSet({ from: -3, to: 99 }));
    expect(now().playback.region).toEqual({ from: 0, to: 10 });
    does(change.regionSet({ from: 10, to: 10 }));
    expect(now().playback.region?.from).toBeCloseTo(10 - change.MIN_LOOP);
    does(change.regionSet(null));
    expect(now().playback).toMatchObject({ region: null, loop: false });
  });

  it('its ends are set one by one, and an end on the wrong side starts over', () => {
    does(change.regionEndSet('from', 4));
    expect(now().playback.region).toEqual({ from: 4, to: 10 });
    does(change.regionEndSet('to', 6));
    expect(now().playback.region).toEqual({ from: 4, to: 6 });
    does(change.regionEndSet('to', 3));
    expect(now().playback.region).toEqual({ from: 0, to: 3 });
    does(change.regionEndSet('from', 8));
    expect(now().playback.region).toEqual({ from: 8, to: 10 });
  });

  it('zooms around the playhead, and the whole dance ends the zoom', () => {
    does(store.playbackSet({ time: 5 }));
    does(change.zoomedBy(2));
    expect(now().zoom).toEqual({ from: 2.5, to: 7.5 });
    does(change.scrolledTo(9));
    expect(now().zoom?.to).toBe(10);
    does(change.magnificationSet(1));
    expect(now().zoom).toBeNull();
    expect(change.visibleSpan(now())).toEqual({ from: 0, to: 10 });
  });

  it('shifts by whole frames as long as a second of the song stays in the dance', () => {
    does(change.shiftSet(7.4));
    expect(now().shift).toBe(7);
    expect(shift.songStart(now())).toBeCloseTo(7 / 30);
    expect(shift.musicBeats(now())[2]).toBeCloseTo(1 + 7 / 30);
    does(change.shiftSet(1e6));
    expect(now().shift).toBe(270);
    does(change.shiftSet(-1e6));
    expect(now().shift).toBe(-150);
  });

  it('a shift asks for another reaction; without a song there is none', () => {
    const before = readyInputs(now());
    does(change.shiftSet(7));
    const after = readyInputs(now());
    expect(after?.shift).toBe(7);
    expect(sameInputs(before, after)).toBe(false);
    page = store.createAppStore('dark');
    does(store.manifestLoaded(small, 7));
    does(store.leaderLoaded(leader(300)));
    does(change.shiftSet(7));
    expect(readyInputs(now())?.shift).toBe(0);
  });

  it('another leader or song comes unshifted, another leader without region and zoom', () => {
    does(change.shiftSet(7));
    does(change.regionSet({ from: 1, to: 2 }));
    does(change.zoomedBy(4));
    does(store.songLoaded(song(6)));
    expect(now()).toMatchObject({ shift: 0, playback: { region: { from: 1, to: 2 } } });
    does(store.leaderLoaded(leader(300)));
    expect(now()).toMatchObject({ shift: 0, zoom: null, playback: { region: null } });
  });

  it('without a leader another song changes the length', () => {
    page = store.createAppStore('dark');
    does(store.songLoaded(song(6)));
    does(change.regionSet({ from: 4, to: 5 }));
    does(change.zoomedBy(2));
    does(store.songLoaded(song(3)));
    expect(now()).toMatchObject({ zoom: null, playback: { region: null } });
  });

  it('formats shifts', () => {
    expect(shift.frameCountText(7)).toBe('+7 frames');
    expect(shift.frameCountText(-1)).toBe('−1 frame');
    expect(shift.shiftText(15, now())).toBe('+15 frames, 0.50 s later');
    expect(shift.shiftText(-3, now())).toBe('−3 frames, 0.10 s earlier');
  });

  it('suggests the shift that brings accents and beats together, and says why it suggests none', () => {
    expect(shift.shiftAdvice({ ...now(), song: null })).toBeNull();
    expect(shift.shiftAdvice(now())).toMatchObject({ better: null, summary: 'too few beats' });
    // It swings once in 30 frames and stands still every half second; the song has its beats 4 frames earlier.
    const swinging = (still: number) => {
      const made = leader(300);
      for (let frame = 0; frame < 300; frame++)
        made.motion.positions.fill(
          Math.cos((Math.PI * (frame + 0.3 - still)) / 15),
          frame * 66,
          frame * 66 + 66,
        );
      return made;
    };
    does(store.songLoaded(song(10)));
    does(store.leaderLoaded(swinging(5)));
    expect(shift.shiftAdvice(now())?.better?.by).toBe(4);
    does(change.shiftSet(4));
    expect(shift.shiftAdvice(now())).toMatchObject({
      better: null,
      summary: 'timing fits',
      reason: expect.stringMatching(/, the best within two seconds\. Drag/) as string,
    });
    // Beats of another tempo: some shift is best, as one of any has to be.
    const other = song(10);
    const beats = Array.from({ length: 23 }, (_, beat) => 0.1 + 0.43 * beat);
    does(store.songLoaded({ ...other, data: { ...other.data, rhythm: rhythm(beats) } }));
    expect(shift.shiftAdvice(now())).toMatchObject({
      better: null,
      reason: expect.stringMatching(/s (later|earlier), a difference that may be chance\. Drag/) as string,
    });
  });
});
