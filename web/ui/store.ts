import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Manifest } from '../model/client';
import { toStep } from './format';
import { danceDuration } from './selectors';
import type {
  AppState,
  Camera,
  Job,
  Layer,
  LoadedLeader,
  LoadedSong,
  ModelState,
  Playback,
  Problem,
  Reaction,
  Reading,
  Settings,
  Side,
  Theme,
} from './state';

/** Everything that can happen to the state. A change is a pure function from state to what differs. */
export type Change = (state: AppState) => Partial<AppState>;
export type Store = StoreApi<AppState>;

export const SPEEDS = [0.25, 0.5, 0.75, 1, 1.25, 1.5, 2] as const;

/** The state before anything is loaded. */
export function initialState(theme: Theme): AppState {
  return {
    theme,
    camera: 'orbit',
    visiting: true,
    demo: 'loading',
    open: null,
    model: { phase: 'loading', label: 'Model', received: 0, total: 0 },
    manifest: null,
    settings: null,
    song: null,
    leader: null,
    reading: { song: null, leader: null },
    reaction: null,
    footLock: true,
    job: null,
    problem: null,
    waitingProblems: [],
    remarks: [],
    playback: { playing: false, time: 0, speed: 1, loop: false },
  };
}

/** The one store of the page. */
export function createAppStore(theme: Theme): Store {
  return createStore<AppState>()(() => initialState(theme));
}

/** Applies a change. */
export function apply(store: Store, change: Change): void {
  store.setState(change);
}

/** Calls back now and whenever the selected part is another value; returns the unsubscription. */
export function watch<T>(
  store: Store,
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

/** `watch` for several parts at once. */
export function watchAll(
  store: Store,
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

// ---- the model ----

/** The manifest brings the settings' defaults; settings made before it (a second model) start over. */
export function manifestArrived(manifest: Manifest, seed: number): Change {
  return () => ({
    manifest,
    settings: {
      guidance: { coarse: preset(manifest, 'coarse'), fine: preset(manifest, 'fine') },
      steps: manifest.diffusion.steps.default,
      seed,
    },
  });
}

/** Another model takes over: its own defaults, and no song that was heard in a way it does not know. */
export function modelOpened(manifest: Manifest, seed: number): Change {
  return (state) => {
    const before = state.manifest;
    const hearsAlike = before && JSON.stringify(before.audio) === JSON.stringify(manifest.audio);
    const lost =
      state.song && !hearsAlike ? ` It hears songs in another way: drop ${state.song.name} again.` : '';
    return {
      ...manifestArrived(manifest, seed)(state),
      ...(lost && { song: null }),
      remarks: [...state.remarks, `The partner is danced by your model “${manifest.name}”.${lost}`],
    };
  };
}

/** The manifest's own choice for a layer; 0, the plain condition, for a layer that it does not name. */
function preset(manifest: Manifest, layer: Layer): number {
  return manifest.guidance.default[layer] ?? 0;
}

export function modelChanged(model: ModelState): Change {
  return () => ({ model });
}

// ---- settings ----

/** Sets all of them, as a ready-made reaction was made with. */
export function settingsSet(settings: Settings): Change {
  return () => ({ settings });
}

/** Sets one layer's guidance, held to the manifest's range and step. */
export function guidanceSet(layer: Layer, value: number): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest) return {};
    const { min, max, step } = manifest.guidance;
    const held = toStep(Math.min(max, Math.max(min, value)), step, min);
    if (held === settings.guidance[layer]) return {};
    return { settings: { ...settings, guidance: { ...settings.guidance, [layer]: held } } };
  };
}

/** Puts one layer, or without a layer both, back to the manifest's default. */
export function guidanceReset(layer?: Layer): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest) return {};
    const guidance = {
      coarse: layer === 'fine' ? settings.guidance.coarse : preset(manifest, 'coarse'),
      fine: layer === 'coarse' ? settings.guidance.fine : preset(manifest, 'fine'),
    };
    return { settings: { ...settings, guidance } };
  };
}

export function stepsSet(steps: number): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest || !Number.isFinite(steps)) return {};
    const { min, max } = manifest.diffusion.steps;
    return { settings: { ...settings, steps: Math.min(max, Math.max(min, Math.round(steps))) } };
  };
}

export function seedSet(seed: number): Change {
  return ({ settings }) => {
    if (!settings || !Number.isFinite(seed)) return {};
    return { settings: { ...settings, seed: Math.min(0xffffffff, Math.max(0, Math.round(seed))) } };
  };
}

// ---- files ----

export function readingSet(side: Side, reading: Reading | null): Change {
  return (state) => ({ reading: { ...state.reading, [side]: reading } });
}

/** A song is there: the reaction shown stays until the one that hears it is ready. */
export function songLoaded(song: LoadedSong): Change {
  return (state) => ({ song, reading: { ...state.reading, song: null } });
}

/** A leader is there: what answered another leader makes no sense beside this one and leaves. */
export function leaderLoaded(leader: LoadedLeader): Change {
  return (state) => ({
    leader,
    reaction: null,
    reading: { ...state.reading, leader: null },
    playback: { ...state.playback, time: 0, playing: false },
  });
}

export function visitEnded(): Change {
  return (state) => (state.visiting ? { visiting: false } : {});
}

export function demoChanged(demo: AppState['demo']): Change {
  return () => ({ demo });
}

// ---- generation ----

export function jobChanged(job: Job | null): Change {
  return () => ({ job });
}

export function reacted(reaction: Reaction): Change {
  return () => ({ reaction, job: null });
}

export function footLockSet(footLock: boolean): Change {
  return () => ({ footLock });
}

/** Keeps something worth knowing that stops nothing. */
export function remarked(remark: string): Change {
  return ({ remarks }) => (remarks.includes(remark) ? {} : { remarks: [...remarks, remark] });
}

/** Tells of a failure; while another one is being told, it waits its turn. */
export function told(problem: Problem): Change {
  return (state) => {
    if (!state.problem) return { problem };
    const known = [state.problem, ...state.waitingProblems].some(
      ({ code, title }) => code === problem.code && title === problem.title,
    );
    return known ? {} : { waitingProblems: [...state.waitingProblems, problem] };
  };
}

/** Closes the failure in front; the next one, if any, is told. */
export function dismissed(): Change {
  return ({ waitingProblems: [next, ...rest] }) => ({ problem: next ?? null, waitingProblems: rest });
}

// ---- playing and looking ----

/** Changes the transport; the time stays inside the dance. */
export function playbackSet(change: Partial<Playback>): Change {
  return (state) => {
    const playback = { ...state.playback, ...change };
    const time = Math.min(danceDuration(state), Math.max(0, playback.time));
    return { playback: { ...playback, time } };
  };
}

export function themeSet(theme: Theme): Change {
  return () => ({ theme });
}

export function cameraSet(camera: Camera): Change {
  return () => ({ camera });
}

/** Opens a floating thing, or closes it when it is the one that is open. */
export function opened(open: AppState['open']): Change {
  return (state) => ({ open: state.open === open ? null : open });
}
