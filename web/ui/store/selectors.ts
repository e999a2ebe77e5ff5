import { bytesOf, duration, rate } from './format';
import { guidanceAt, sameGuidance } from './guidance-matrix';
import type { Inputs, Settings } from './reaction';
import type { AppState, Job, AutosaveStatus } from './state';

/** Length of what plays, seconds: the leader's; without a leader the song's. */
export function danceDuration(state: Pick<AppState, 'leader' | 'song'>): number {
  if (state.leader) return state.leader.file.clip.frames / state.leader.file.clip.fps;
  return state.song?.data.duration ?? 0;
}

/**
 * Playhead, loop and zoom after a change that may bring another leader: inside the dance, and all of another leader's is
 * shown.
 */
export function timelineWithin(before: AppState, after: AppState): Pick<AppState, 'playback' | 'zoom'> {
  const { playback, zoom, leader } = after;
  const { time, region } = playback;
  const whole = danceDuration(after);
  const fits = time <= whole && (!region || region.to <= whole);
  return {
    playback: fits
      ? playback
      : { ...playback, time: Math.min(time, whole), region: region && region.to <= whole ? region : null },
    zoom: leader === before.leader ? zoom : null,
  };
}

/** Frames per second of the dance; while there is no leader, of what the model makes. */
export function danceFps({ leader, manifest }: Pick<AppState, 'leader' | 'manifest'>): number {
  return leader?.file.clip.fps ?? manifest?.fps ?? 1; // without either nothing has a length
}

/** What a reaction would be generated from now; null while something is missing or still being read. */
export function readyInputs(state: AppState): Inputs | null {
  const { leader, song, shift, settings, reading } = state;
  if (!leader || !settings || reading.song || reading.leader) return null;
  return { leader, song, shift: song ? shift : 0, settings };
}

export function sameSettings(a: Settings, b: Settings): boolean {
  return (
    a.seed === b.seed &&
    a.role === b.role &&
    a.music === b.music &&
    a.variety === b.variety &&
    a.height === b.height &&
    a.holdHands === b.holdHands &&
    sameGuidance(a.guidance, b.guidance)
  );
}

export function sameInputs(a: Inputs | null, b: Inputs | null): boolean {
  if (!a || !b) return a === b;
  const sameFiles = a.leader === b.leader && a.song === b.song;
  // Without a song nothing is shifted: takes whose song can't be read any more still say where it began.
  const sameShift = a.song === null || a.shift === b.shift;
  return sameFiles && sameShift && sameSettings(a.settings, b.settings);
}

/** Whether two requests have the same sampled latents, or the same inputs: weights and settings of solving may differ. */
export function differOnlyInWeights(a: Inputs, b: Inputs): boolean {
  const { seed, role } = a.settings;
  return sameInputs({ ...a, settings: { ...b.settings, seed, role } }, b);
}

/** Whether the reaction on the stage is the one that files and settings ask for. */
export function upToDate(state: AppState): boolean {
  return state.reaction !== null && sameInputs(state.reaction.inputs, readyInputs(state));
}

/** Guidance as the model takes it: streams x layers in the manifest's order, row-major. */
export function guidanceMatrix(
  settings: Settings,
  latent: { readonly streams: readonly string[]; readonly layers: readonly string[] },
): Float32Array {
  const { streams, layers } = latent;
  return Float32Array.from(
    streams.flatMap((stream) => layers.map((layer) => guidanceAt(settings.guidance, stream, layer))),
  );
}

/** Whether the reaction on the stage is being replaced by one that is sampled, which takes seconds. */
export function isSampling(state: AppState): boolean {
  return state.job !== null && state.job.fraction > 0 && !upToDate(state);
}

/** The stage of a job as a text for the visitor. */
export function jobText(job: Job, { model }: Pick<AppState, 'model'>): string {
  switch (job.stage) {
    case 'waiting':
      if (model.phase === 'ready') return 'shaping the dance';
      return model.phase === 'loading' && model.total > 0
        ? `waiting for the model, ${bytesOf(model.received, model.total)}`
        : 'waiting for the model';
    case 'condition':
      return 'reading song and leader';
    case 'step':
      return 'sampling the dance';
  }
}

/** A sentence on how the lengths of song and leader differ; null when they match within half a second. */
export function lengthNote({
  song,
  leader,
  shift,
  reading,
}: Pick<AppState, 'song' | 'leader' | 'shift' | 'reading'>): string | null {
  if (!leader || reading.song) return null;
  const dance = danceDuration({ leader, song });
  if (!song) return 'No song: the couple dances in silence.';
  const end = song.data.duration + shift / leader.file.clip.fps;
  const rest = dance - end;
  if (rest > 0.5) return `The song ends at ${duration(end)}; silence follows to the end of the dance.`;
  if (rest < -0.5) return `The dance ends at ${duration(dance)}; the rest of the song is not used.`;
  return null;
}

/** Whether a song and whether a leader is being read; unlike the progress, this changes seldom. */
export function isReading({ reading }: Pick<AppState, 'reading'>): [boolean, boolean] {
  return [reading.song !== null, reading.leader !== null];
}

const AUTOSAVE_NOTES: Readonly<Record<AutosaveStatus, string | null>> = {
  stored: null,
  full:
    'The space that this browser has for the page is full: what does not fit is lost when the page is closed. ' +
    'Delete takes that you don’t need, or save a project file.',
  refused:
    'This browser saves nothing for the page: takes are lost when the page is closed. Save a project file to keep them.',
  // These two are over the stage, with what to do about them.
  elsewhere: null,
  newer: null,
};

const PERSISTENT = 'The browser has promised to keep them, also when this device runs out of space.';
const NOT_PERSISTENT =
  'The browser may remove them when this device runs out of space. A project file is safe from that.';

/** Whether the browser has promised to keep what is stored, in a sentence; null while nobody has asked it. */
export function persistenceText({
  persistent,
  autosave,
}: Pick<AppState, 'persistent' | 'autosave'>): string | null {
  if (persistent === null || autosave === 'refused' || autosave === 'newer') return null;
  return persistent ? PERSISTENT : NOT_PERSISTENT;
}

/** A sentence about the inputs; a warning is about something that may make the result worse. */
export interface Note {
  readonly text: string;
  readonly isWarning: boolean;
}

/** Short enough for the two lines of the transport. */
const UNFAMILIAR =
  'This leader moves unlike the dancers that the model learned from: the partner may look odd.';

/** Whether the reaction on the stage is to a leader unlike those that the model was trained on. */
function isUnfamiliar({ reaction, manifest }: AppState): boolean {
  return (reaction?.unfamiliarity ?? 0) > (manifest?.leader.unfamiliar_from ?? Infinity);
}

/** Notes on the song and the leader. */
function fileNotes(state: AppState): Note[] {
  const { song, leader } = state;
  const list: Note[] = [];
  const length = lengthNote(state);
  if (length) list.push({ text: length, isWarning: false });
  if (song?.data.silent)
    list.push({ text: 'The song is silent: there is no beat to dance to.', isWarning: true });
  else if (song && song.data.rhythm.beats.length === 0)
    list.push({ text: 'No steady beat was found in the song.', isWarning: true });
  else if (song && !song.data.rhythm.sure)
    list.push({ text: 'The beat of the song is hard to find: check the count.', isWarning: true });
  if (isUnfamiliar(state)) list.push({ text: UNFAMILIAR, isWarning: true });
  for (const warning of leader?.file.report.warnings ?? []) list.push({ text: warning, isWarning: true });
  for (const remark of leader?.file.report.remarks ?? []) list.push({ text: remark, isWarning: false });
  return list;
}

/** All notes. */
export function notes(state: AppState): Note[] {
  const list = fileNotes(state);
  const autosaveNote = AUTOSAVE_NOTES[state.autosave];
  if (autosaveNote) list.push({ text: autosaveNote, isWarning: true });
  for (const remark of state.notices) list.push({ text: remark, isWarning: true });
  return list;
}

/** The first note on the files, where there is room for one only: a warning if there is any. */
export function firstNote(state: AppState): Note | null {
  const list = fileNotes(state);
  return list.find(({ isWarning }) => isWarning) ?? list[0] ?? null;
}

/** `60 to 30 fps`, or `30 fps` when nothing is resampled. */
export function rateText(sourceFps: number, fps: number): string {
  return Math.abs(sourceFps - fps) < 0.01 ? `${rate(fps)} fps` : `${rate(sourceFps)} to ${rate(fps)} fps`;
}
