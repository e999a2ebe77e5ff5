import * as v from 'valibot';
import { together } from '../widgets/dom';
import { NO_OVERLAYS } from '../store/overlays';
import type { AppState, Theme } from '../store/state';
import { apply, watch, watchAll, type Change, type Store } from '../store/store';
import { SPEEDS, themeSet } from '../store/actions/view';

const KEY = 'reactdance.preferences';

const isSpeed = (value: number): boolean => SPEEDS.some((speed) => speed === value);

/** Each value stands for itself: one that is missing, old or broken takes its default and leaves the others. */
const schema = v.object({
  /** Null follows the system. */
  theme: v.fallback(v.nullable(v.picklist(['dark', 'light'])), null),
  camera: v.fallback(v.picklist(['orbit', 'follow', 'top', 'side']), 'orbit'),
  speed: v.fallback(v.pipe(v.number(), v.check(isSpeed)), 1),
  loop: v.fallback(v.boolean(), false),
  footLock: v.fallback(v.boolean(), true),
  seedLocked: v.fallback(v.boolean(), false),
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

/** How the visitor likes the page. What was made on it is kept elsewhere. */
export type Preferences = v.InferOutput<typeof schema>;

const restored =
  ({ theme, camera, speed, loop, footLock, seedLocked, shown: overlays }: Preferences): Change =>
  (state) => ({
    theme: theme ?? state.theme,
    camera,
    footLock,
    seedLocked,
    overlays,
    playback: { ...state.playback, speed, loop },
  });

const chosen = (
  { camera, footLock, seedLocked, overlays, playback: { speed, loop } }: AppState,
  theme: Theme | null,
): Preferences => ({
  theme,
  camera,
  speed,
  loop,
  footLock,
  seedLocked,
  shown: overlays,
});

/** The part of localStorage that is needed. */
export type PreferenceStorage = Pick<Storage, 'getItem' | 'setItem'>;

/** The system's theme: tells when it changes, returns how to stop. */
export type WatchTheme = (change: (theme: Theme) => void) => () => void;

/**
 * Takes the preferences of earlier visits and keeps those of this one.
 * @param storage gives the place to keep them; may throw or give nothing, as browsers do in private windows
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
  return together(
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
  let kept: unknown = null;
  try {
    kept = JSON.parse(storage()?.getItem(KEY) ?? 'null');
  } catch {
    // Forbidden storage, or no JSON.
  }
  const result = v.safeParse(schema, kept);
  return result.success ? result.output : v.parse(schema, {});
}
