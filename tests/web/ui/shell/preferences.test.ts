import type { Theme } from '../../../../web/common/picture';
import { describe, expect, it } from 'vitest';
import { syncPreferences, type PreferenceStorage } from '../../../../web/ui/shell/preferences';
import { firstVisitEnded } from '../../../../web/ui/store/actions/files';
import { footLockSet } from '../../../../web/ui/store/actions/reaction';
import { seedLockSet } from '../../../../web/ui/store/actions/settings';
import { apply, createAppStore } from '../../../../web/ui/store/store';
import { cameraSet, playbackSet, overlayToggled, themeSet } from '../../../../web/ui/store/actions/view';

const KEY = 'reactdance.preferences';

/** A browser: its storage, and a system whose theme may change. */
function browser(kept?: string) {
  const values = new Map<string, string>(kept === undefined ? [] : [[KEY, kept]]);
  const storage: PreferenceStorage = {
    getItem: (key) => values.get(key) ?? null,
    setItem: (key, value) => void values.set(key, value),
  };
  let tell: (theme: Theme) => void = () => undefined;
  return {
    values,
    system: (theme: Theme) => {
      tell(theme);
    },
    /** A visit to the page on a dark system. */
    visit: (place: () => PreferenceStorage | null = () => storage) => {
      const store = createAppStore('dark');
      const stop = syncPreferences(store, place, (change) => {
        tell = change;
        return () => undefined;
      });
      return { store, stop };
    },
  };
}

describe('preferences', () => {
  it('are restored from the last visit', () => {
    const { visit } = browser();
    const { store, stop } = visit();
    apply(store, themeSet('light'));
    apply(store, cameraSet('top'));
    apply(store, footLockSet(false));
    apply(store, seedLockSet(true));
    apply(store, overlayToggled('trails'));
    apply(store, playbackSet({ speed: 0.5, loop: true }));
    apply(store, firstVisitEnded());
    stop();
    const { theme, camera, footLock, seedLocked, firstVisit, overlays, playback } = visit().store.getState();
    expect([seedLocked, firstVisit]).toEqual([true, false]);
    expect(overlays).toMatchObject({ trails: true, skeleton: false });
    expect({ theme, camera, footLock, speed: playback.speed, loop: playback.loop }).toEqual({
      theme: 'light',
      camera: 'top',
      footLock: false,
      speed: 0.5,
      loop: true,
    });
  });

  it('are not written while nothing is chosen, and not with every frame that plays', () => {
    const { visit, values } = browser();
    const { store } = visit();
    apply(store, playbackSet({ time: 1 }));
    expect(values.size).toBe(0);
  });

  it.each([
    ['no JSON', '{'],
    ['another kind', '[1, 2]'],
    ['null', 'null'],
    ['values of another time', '{"theme":"sepia","camera":"drone","speed":17,"loop":"yes","footLock":null}'],
  ])('that are broken (%s) take their defaults', (_, kept) => {
    const fresh = createAppStore('dark').getState();
    expect(browser(kept).visit().store.getState()).toEqual(fresh);
  });

  it('keep valid values beside invalid ones', () => {
    const { camera, playback } = browser('{"camera":"side","speed":"fast"}').visit().store.getState();
    expect([camera, playback.speed]).toEqual(['side', 1]);
  });

  it('follow the theme of the system until one is chosen', () => {
    const { visit, system, values } = browser();
    const { store } = visit();
    system('light');
    expect(store.getState().theme).toBe('light');
    expect(values.size).toBe(0);
    apply(store, themeSet('dark'));
    system('light');
    expect(store.getState().theme).toBe('dark');
    // A choice that happens to be the system's own stays a choice.
    expect(values.get(KEY)).toContain('"theme":"dark"');
  });

  it.each<[string, () => PreferenceStorage | null]>([
    [
      'forbidden',
      () => {
        throw new DOMException('denied', 'SecurityError');
      },
    ],
    ['missing', () => null],
    [
      'full',
      () => ({
        getItem: () => null,
        setItem: () => {
          throw new DOMException('full', 'QuotaExceededError');
        },
      }),
    ],
  ])('last for the visit where storage is %s', (_, place) => {
    const { store } = browser().visit(place);
    apply(store, cameraSet('top'));
    expect(store.getState().camera).toBe('top');
  });
});
