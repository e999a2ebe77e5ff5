import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Manifest } from '../model/client';
import { otherRole } from './couple';
import { columnOf, defaultGuidance, guidanceAt, sameGuidance, withCell, withColumn } from './guidance-matrix';
import type { Reference } from './quality-reference';
import { danceDuration } from './selectors';
import { NOTHING_SHOWN } from './shows';
import type {
  AppState,
  Camera,
  CoarseLayer,
  Fresh,
  Guidance,
  Job,
  Layer,
  LoadedLeader,
  LoadedSong,
  ModelState,
  Playback,
  Preview,
  Problem,
  Quality,
  Reaction,
  Reading,
  Settings,
  Shown,
  Side,
  Theme,
} from './state';
import { NO_HISTORY, remembered } from './takes/history';
import { arrived, newStamp, type Stamp } from './takes/arrival';
import { ofAnotherModel } from './takes/take';

/** Everything that can happen to the state. A change is a pure function from state to what differs. */
export type Change = (state: AppState) => Partial<AppState>;
export type Store = StoreApi<AppState>;

export const SPEEDS = [0.25, 0.5, 0.75, 1, 1.25, 1.5, 2] as const;

/** The state before anything is loaded. */
export function initialState(theme: Theme): AppState {
  return {
    theme,
    camera: 'orbit',
    shown: NOTHING_SHOWN,
    coarse: { motion: null, other: null, decoding: false },
    visiting: true,
    demo: 'loading',
    open: null,
    update: false,
    model: { phase: 'loading', label: 'Model', received: 0, total: 0 },
    manifest: null,
    settings: null,
    song: null,
    leader: null,
    shift: 0,
    reading: { song: null, leader: null },
    reaction: null,
    preview: null,
    choices: null,
    seedLocked: false,
    takes: [],
    takesMade: 0,
    other: null,
    letter: 'A',
    compare: 'off',
    history: NO_HISTORY,
    keeping: 'kept',
    footLock: true,
    quality: null,
    reference: null,
    job: null,
    download: { who: 'reactor', format: 'bvh', size: '1080p' },
    writing: null,
    filming: null,
    saved: null,
    problem: null,
    waitingProblems: [],
    remarks: [],
    playback: { playing: false, time: 0, speed: 1, loop: false, region: null },
    zoom: null,
  };
}

/** The one store of the page. */
export function createAppStore(theme: Theme): Store {
  return createStore<AppState>()(() => initialState(theme));
}

/** Applies a change; what the visitor may want to take back is remembered. */
export function apply(store: Store, change: Change): void {
  store.setState((state) => remembered(state, change(state), Date.now()));
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
      guidance: defaultGuidance(manifest),
      steps: manifest.diffusion.steps.default,
      seed,
      role: 'reactor',
    },
  });
}

/** Another model takes over: its own defaults, and no song that was heard in a way it does not know. */
export function modelOpened(manifest: Manifest, seed: number): Change {
  return (state) => {
    const before = state.manifest;
    const hearsAlike = before !== null && JSON.stringify(before.audio) === JSON.stringify(manifest.audio);
    const lost =
      state.song && !hearsAlike ? ` It hears songs in another way: drop ${state.song.name} again.` : '';
    return {
      ...manifestArrived(manifest, seed)(state),
      ...(!hearsAlike && { song: null, shift: 0 }),
      ...ofAnotherModel(state, hearsAlike),
      // What another model was asked for can't be asked of this one.
      history: NO_HISTORY,
      remarks: [...state.remarks, `The partner is danced by your model “${manifest.name}”.${lost}`],
    };
  };
}

export function modelChanged(model: ModelState): Change {
  return () => ({ model });
}

// ---- settings ----

/** Sets all of them, as a ready-made reaction was made with. */
export function settingsSet(settings: Settings): Change {
  return () => ({ settings });
}

/**
 * Moves one layer of all streams together, held to the manifest's range and step (see `withColumn`).
 * @param from where the streams stood when the fader was taken in hand; where they stand now when not given
 */
export function guidanceSet(layer: Layer, value: number, from?: Guidance): Change {
  return guided((guidance, { guidance: range }) => withColumn(from ?? guidance, layer, value, range));
}

/** Sets one layer of one stream. */
export function guidanceCellSet(stream: string, layer: string, value: number): Change {
  return guided((guidance, { guidance: range }) => withCell(guidance, stream, layer, value, range));
}

/** Sets the whole matrix, as a preset does. */
export function guidanceMatrixSet(guidance: Guidance): Change {
  return guided(() => guidance);
}

/** Back to the manifest's guidance: one layer of all streams, or everything. */
export function guidanceReset(layer?: Layer): Change {
  return guided((guidance, manifest) => {
    const own = defaultGuidance(manifest);
    if (!layer) return own;
    return Object.keys(guidance).reduce(
      (all, stream) => withCell(all, stream, layer, columnOf(own, layer).value, manifest.guidance),
      guidance,
    );
  });
}

/** Back to the manifest's guidance for one layer of one stream. */
export function guidanceCellReset(stream: string, layer: string): Change {
  return guided((guidance, manifest) =>
    withCell(
      guidance,
      stream,
      layer,
      guidanceAt(defaultGuidance(manifest), stream, layer),
      manifest.guidance,
    ),
  );
}

/** A change of the guidance alone; settings stay the same object when it comes out as it was. */
function guided(next: (guidance: Guidance, manifest: Manifest) => Guidance): Change {
  return ({ settings, manifest }) => {
    if (!settings || !manifest) return {};
    const guidance = next(settings.guidance, manifest);
    return sameGuidance(guidance, settings.guidance) ? {} : { settings: { ...settings, guidance } };
  };
}

/**
 * The dancers change parts. What the model danced in its old part makes no sense in the new one and leaves; who is
 * taken home is the one who is made.
 */
export function rolesSwapped(): Change {
  return ({ settings, download }) => {
    if (!settings) return {};
    const role = otherRole(settings.role);
    const who = download.who === 'both' ? 'both' : role;
    return { settings: { ...settings, role }, download: { ...download, who }, reaction: null, preview: null };
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

/** Another seed, unless it is locked. */
export function seedRolled(seed: number): Change {
  return (state) => (state.seedLocked ? {} : seedSet(seed)(state));
}

export function seedLockSet(seedLocked: boolean): Change {
  return () => ({ seedLocked });
}

// ---- files ----

export function readingSet(side: Side, reading: Reading | null): Change {
  return (state) => ({ reading: { ...state.reading, [side]: reading } });
}

/** A song is there, unshifted: the reaction shown stays until the one that hears it is ready. */
export function songLoaded(song: LoadedSong): Change {
  return (state) => ({
    song,
    shift: 0,
    reading: { ...state.reading, song: null },
    // Without a leader the song alone is what plays: another one is another length.
    ...(!state.leader && { zoom: null, playback: { ...state.playback, region: null } }),
  });
}

/** A leader is there: what answered another leader makes no sense beside this one and leaves. */
export function leaderLoaded(leader: LoadedLeader): Change {
  return (state) => ({
    leader,
    shift: 0,
    zoom: null,
    reaction: null,
    preview: null,
    reading: { ...state.reading, leader: null },
    playback: { ...state.playback, time: 0, playing: false, region: null },
  });
}

export function visitEnded(): Change {
  return (state) => (state.visiting ? { visiting: false } : {});
}

export function demoChanged(demo: AppState['demo']): Change {
  return () => ({ demo });
}

// ---- generation ----

/** How far a job is; with null it is over, and what it had shown early leaves the stage. */
export function jobChanged(job: Job | null): Change {
  return () => (job ? { job } : { job, preview: null });
}

/** Part of the coming reaction is on the stage. */
export function previewed(preview: Preview, fresh: Fresh): Change {
  return ({ job }) => (job ? { preview, job: { ...job, fresh } } : {});
}

/** A reaction is ready: it is shown and becomes a take. */
export function reacted(reaction: Reaction, stamp: Stamp = newStamp()): Change {
  return (state) => ({ ...arrived(state, reaction, stamp), reaction, job: null, preview: null });
}

export function footLockSet(footLock: boolean): Change {
  return () => ({ footLock });
}

export function measured(quality: Quality | null): Change {
  return () => ({ quality });
}

export function referenceKnown(reference: Reference | null): Change {
  return () => ({ reference });
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

export function updateSet(update: boolean): Change {
  return () => ({ update });
}

/** Shows something about the dancers, or leaves it out again. */
export function shownToggled(what: keyof Shown): Change {
  return ({ shown }) => ({ shown: { ...shown, [what]: !shown[what] } });
}

export function coarseChanged(change: Partial<CoarseLayer>): Change {
  return ({ coarse }) => ({ coarse: { ...coarse, ...change } });
}

/** Opens a floating thing, or closes it when it is the one that is open. */
export function opened(open: AppState['open']): Change {
  return (state) => ({ open: state.open === open ? null : open });
}
