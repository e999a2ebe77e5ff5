import { NO_OVERLAYS, type Theme } from '../../common/picture';
import { FPS } from '../../motion/skeleton/clip';
import type { AppState } from './state';
import { NO_HISTORY, withUndo } from './history/history';
import { createStore, type StoreApi } from 'zustand/vanilla';

/** A pure function from the state to the fields that change. */
export type Change = (state: AppState) => Partial<AppState>;
export type Store = StoreApi<AppState>;

/** A state that can be watched: the store's, or one that is computed from it. */
export interface Watched {
  readonly getState: () => AppState;
  readonly subscribe: (listener: (state: AppState) => void) => () => void;
}

/** The state before anything is loaded. */
export function initialState(theme: Theme): AppState {
  return {
    theme,
    camera: 'orbit',
    overlays: NO_OVERLAYS,
    coarse: { motion: null, other: null, decoding: false },
    firstVisit: true,
    demo: 'loading',
    openPanel: null,
    update: false,
    model: { phase: 'loading', label: 'Model', received: 0, total: 0 },
    manifest: null,
    settings: null,
    song: null,
    leader: null,
    refusedLeader: null,
    shift: 0,
    countings: [],
    settingOne: false,
    reading: { song: null, leader: null },
    reaction: null,
    preview: null,
    drag: null,
    earlier: null,
    variations: null,
    seedLocked: false,
    letterKeys: true,
    takes: [],
    takesMade: 0,
    other: null,
    letter: 'A',
    compare: 'off',
    history: NO_HISTORY,
    asked: [],
    autosave: 'stored',
    persistent: null,
    restoring: null,
    footLock: true,
    quality: null,
    reference: null,
    job: null,
    download: {
      who: 'generated',
      part: 'whole',
      format: 'bvh',
      rate: FPS,
      size: '1080p',
      title: '',
      credit: '',
      beside: false,
    },
    writing: null,
    videoProgress: null,
    saved: null,
    problem: null,
    queuedProblems: [],
    given: null,
    notices: [],
    toast: null,
    playback: { playing: false, time: 0, speed: 1, loop: false, region: null },
    partRead: null,
    covered: 0,
    zoom: null,
  };
}

/** The one store of the page. */
export function createAppStore(theme: Theme): Store {
  return createStore<AppState>()(() => initialState(theme));
}

/** Applies a change and adds it to the undo history, where it is one that visitors undo. */
export function apply(store: Store, change: Change): void {
  store.setState((state) => withUndo(state, change(state), Date.now()));
}

/** Calls back now and whenever the selected value changes; returns the unsubscription. */
export function watch<T>(
  store: Watched,
  select: (state: AppState) => T,
  show: (value: T, state: AppState) => void,
): () => void {
  let shown = select(store.getState());
  show(shown, store.getState());
  return store.subscribe((state) => {
    const value = select(state);
    if (Object.is(value, shown)) return;
    shown = value;
    show(value, state);
  });
}

/** `watch` for several values at once. */
export function watchAll(
  store: Watched,
  select: (state: AppState) => readonly unknown[],
  show: (state: AppState) => void,
): () => void {
  let shown = select(store.getState());
  show(store.getState());
  return store.subscribe((state) => {
    const values = select(state);
    if (values.every((value, index) => Object.is(value, shown[index]))) return;
    shown = values;
    show(state);
  });
}
