import * as v from 'valibot';
import { combineDisposers } from '../widgets/dom';
import { VIEWS } from '../../common/framing';
import { NO_OVERLAYS, type Theme } from '../../common/picture';
import type { AppState } from '../store/state';
import { apply, watch, watchAll, type Change, type Store } from '../store/store';
import { SPEEDS, themeSet } from '../store/actions/view';

const KEY = 'reactdance.preferences';

const isSpeed = (value: number): boolean => SPEEDS.some((speed) => speed === value);

/** A value that is missing or invalid takes its default and leaves the others. */
const schema = v.object({
  /** Null follows the system. */
  theme: v.fallback(v.nullable(v.picklist(['dark', 'light'])), null),
  camera: v.fallback(v.picklist(VIEWS), 'orbit'),
  speed: v.fallback(v.pipe(v.number(), v.check(isSpeed)), 1),
  loop: v.fallback(v.boolean(), false),
  footLock: v.fallback(v.boolean(), true),
  seedLocked: v.fallback(v.boolean(), false),
  letterKeys: v.fallback(v.boolean(), true),
  /** False for who has used the page: they are not greeted as newcomers while their work is looked up. */
  firstVisit: v.fallback(v.boolean(), true),
  shown: v.fallback(
    v.object({
      skeleton: v.boolean(),
      trails: v.boolean(),
      contacts: v.boolean(),
      facing: v.boolean(),
      hands: v.boolean(),
      ghost: v.boolean(),
    }),
    NO_OVERLAYS,
  ),
});

/** Theme, camera and other choices in localStorage; takes and settings are stored by `Project`. */
type Preferences = v.InferOutput<typeof schema>;

const restored =
  ({ theme, speed, loop, shown: overlays, ...others }: Preferences): Change =>
  (state) => ({
    ...others,
    theme: theme ?? state.theme,
    overlays,
    playback: { ...state.playback, speed, loop },
  });

const chosen = (
  { camera, footLock, seedLocked, letterKeys, firstVisit, overlays, playback: { speed, loop } }: AppState,
  theme: Theme | null,
): Preferences => ({
  theme,
  camera,
  speed,
  loop,
  footLock,
  seedLocked,
  letterKeys,
  firstVisit,
  shown: overlays,
});

/** The part of localStorage that is needed. */
export type PreferenceStorage = Pick<Storage, 'getItem' | 'setItem'>;

/** Calls back when the system changes its theme; returns the unsubscription. */
type WatchTheme = (change: (theme: Theme) => void) => () => void;

/**
 * Restores the preferences of earlier visits and stores those of this one.
 * @param storage returns the storage; may throw or return null, as browsers do in private windows
 * @param watchSystem follows the system's theme, which counts as long as the visitor has chosen none
 */
export function syncPreferences(
  store: Store,
  storage: () => PreferenceStorage | null,
  watchSystem: WatchTheme,
): () => void {
  const first = read(storage);
  apply(store, restored(first));
  let written = JSON.stringify(first);
  let theme = first.theme;
  let shown = store.getState().theme;
  let bySystem = false;
  return combineDisposers(
    watchSystem((system) => {
      if (theme !== null) return;
      bySystem = true;
      apply(store, themeSet(system));
      bySystem = false;
    }),
    watch(
      store,
      (state) => state.theme,
      (value) => {
        if (value !== shown && !bySystem) theme = value;
        shown = value;
      },
    ),
    watchAll(
      store,
      (state) => Object.values(chosen(state, state.theme)),
      (state) => {
        const text = JSON.stringify(chosen(state, theme));
        if (text === written) return;
        written = text;
        try {
          storage()?.setItem(KEY, text);
        } catch {
          // Full or forbidden storage: the choice lasts for this visit.
        }
      },
    ),
  );
}

function read(storage: () => PreferenceStorage | null): Preferences {
  let stored: unknown = null;
  try {
    stored = JSON.parse(storage()?.getItem(KEY) ?? 'null');
  } catch {
    // No storage, or no JSON.
  }
  const result = v.safeParse(schema, stored);
  return result.success ? result.output : v.parse(schema, {});
}
