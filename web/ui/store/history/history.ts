import { countWithin } from './history-bytes';
import { sameSettings, timelineWithin } from '../selectors';
import type { Inputs, Settings, Take } from '../reaction';
import type { AppState } from '../state';
import type { Change } from '../store';
import { currentInputs, takeOnStage, withTake } from '../take';

/** A take as it was before and after a step; null where it was not there. */
interface Edit {
  readonly before: Take | null;
  readonly after: Take | null;
}

/** One step that can be undone. It holds only what differed, so that undoing leaves later changes elsewhere alone. */
export interface Step {
  /** What was changed; steps of the same kind in quick succession are one step. Null is never the same kind. */
  readonly kind: string | null;
  /** When it was last added to, milliseconds since 1970. */
  readonly at: number;
  /** The parts of the state as they were. */
  readonly back: Partial<AppState>;
  readonly edits: readonly Edit[];
  /** Brings back what starting over has removed. */
  readonly cleared?: boolean;
  /** The take that was on the stage; a newer reaction of the same drag may have replaced it since. */
  readonly stage: Take | null;
}

/** What can be undone and redone; the last step of each is next. */
export interface History {
  readonly past: readonly Step[];
  readonly future: readonly Step[];
  /** Whether the last step may still be added to. */
  readonly open: boolean;
}

export const NO_HISTORY: History = { past: [], future: [], open: false };

const MAX_STEPS = 100;

/** Most bytes of songs, leaders and motions that only steps of undo hold, besides those of the last step. */
const MAX_BYTES = 64e6;

/** Longest pause between two changes of one gesture, such as a drag of a fader. */
const SAME_GESTURE_MS = 1000;

/** Completes the last step: the next change is a step of its own. */
export function sealed(history: History): History {
  return history.open ? { ...history, open: false } : history;
}

/**
 * Adds to a change the step that undoes it, if it is one that visitors undo: of settings, song, leader, any other
 * input of a reaction, the counting of the song, takes, or the choice of a take. Changes that set `history` themselves are left as they are;
 * new reactions are among them, so that undoing shows the take before and removes none.
 */
export function withUndo(before: AppState, patch: Partial<AppState>, at: number): Partial<AppState> {
  if ('history' in patch) return patch;
  const after = { ...before, ...patch };
  const parts = [
    ...changedInputs(before, after),
    ...(before.countings === after.countings ? [] : (['countings'] as const)),
  ];
  const edits = editsBetween(before.takes, after.takes);
  const chosen = after.reaction !== before.reaction && takeOnStage(after) !== null;
  if (parts.length === 0 && edits.length === 0 && !chosen) return patch;

  const kind = edits.length > 0 ? null : chosen ? 'take' : kindOf(parts, before, after);
  const { past, open } = before.history;
  const last = past.at(-1);
  const held = before.drag?.held === true;
  const sameGesture = held || (last !== undefined && at - last.at < SAME_GESTURE_MS);
  // Two fingers may move two faders.
  const sameKind = last?.kind === kind || (held && isOfSettings(last?.kind) && isOfSettings(kind));
  const continues = open && kind !== null && last !== undefined && sameKind && sameGesture;
  const back = pick(before, [...parts, 'reaction', ...(after.other === before.other ? [] : COMPARISON)]);
  const step: Step = continues
    ? // A take chosen after another one may change more than that did, as the song.
      { ...last, at, back: { ...back, ...last.back } }
    : { kind, at, back, edits, stage: takeOnStage(before) };
  const kept = continues ? past.slice(0, -1) : past;
  if (continues && changesNothing(step, after))
    return { ...patch, history: { past: kept, future: [], open: false } };
  return { ...patch, history: { past: newest([...kept, step], after), future: [], open: true } };
}

/** Whether all is as it was before a step, as after a fader was dragged and brought back. */
function changesNothing({ back: { settings, ...others }, edits }: Step, after: AppState): boolean {
  if (edits.length > 0 || (settings && !(after.settings && sameSettings(settings, after.settings))))
    return false;
  return (Object.keys(others) as (keyof typeof others)[]).every((key) => others[key] === after[key]);
}

/** The last steps, as many as there may be. */
function newest(past: readonly Step[], present: AppState): readonly Step[] {
  const holders = past
    .slice(-MAX_STEPS)
    .toReversed()
    .map(({ back, edits, stage }) => ({
      ...back,
      takes: [...(back.takes ?? []), ...edits.flatMap(({ before, after }) => [before, after]), stage].filter(
        (take) => take !== null,
      ),
    }));
  return past.slice(-countWithin(MAX_BYTES, present, holders));
}

/**
 * A song and a leader that were asked for together are one step: the last two steps become one, where they are the
 * loading of both.
 * @param after the last step before; null where there was none
 */
export function loadingJoined(after: Step | null): Change {
  return ({ history }) => {
    const [first, second, ...more] = history.past.slice(after === null ? 0 : history.past.indexOf(after) + 1);
    if (!first || !second || more.length > 0 || (after !== null && !history.past.includes(after))) return {};
    const kinds = [first, second].map(({ kind }) => (kind ?? '').split(' '));
    if (!(['song', 'leader'] as const).every((kind) => kinds.some((parts) => parts.includes(kind))))
      return {};
    return { history: withLastJoined(history, joined(first, second, null)) };
  };
}

/** The shift that comes with a song or leader, as with those of a video, is part of the step that loaded them. */
export function shiftJoined(): Change {
  return ({ history }) => {
    const [loading, shift] = history.past.slice(-2);
    if (!loading || shift?.kind !== 'shift' || !/song|leader/.test(loading.kind ?? '')) return {};
    return { history: withLastJoined(history, joined(loading, shift, loading.kind)) };
  };
}

/** Two steps, one after the other, as one. */
function joined(first: Step, second: Step, kind: string | null): Step {
  return {
    ...first,
    at: second.at,
    kind,
    back: { ...second.back, ...first.back },
    edits: [...second.edits, ...first.edits],
  };
}

/** With one step in the place of the last two. */
function withLastJoined(history: History, step: Step): History {
  return { ...history, past: [...history.past.slice(0, -2), step], open: false };
}

/** Without the step that would bring back what starting over removed: something new has been made since. */
export function withoutCleared(history: History): History {
  const isOther = ({ cleared = false }: Step): boolean => !cleared;
  if (history.past.every(isOther) && history.future.every(isOther)) return history;
  return { ...history, past: history.past.filter(isOther), future: history.future.filter(isOther) };
}

/** A change that the page makes by itself, such as loading its demo, and that is no step of undo. */
export function withoutUndo(change: Change): Change {
  return (state) => ({ history: state.history, ...change(state) });
}

const COMPARISON = ['other', 'letter', 'compare'] as const;

/** A change that replaces everything at once, with the one step that undoes it. */
export function withUndoOfAll(before: AppState, patch: Partial<AppState>): Partial<AppState> {
  const nothing = before.takes.length === 0 && !before.leader && !before.song;
  if (nothing) return { ...patch, history: NO_HISTORY };
  const step = stepOfAll(before, patch);
  const past = newest([...before.history.past, step], { ...before, ...patch });
  return { ...patch, history: { past, future: [], open: false } };
}

/** A change that empties the page, with the one step that undoes it; what only earlier steps hold is freed. */
export function withUndoOfClearing(before: AppState, patch: Partial<AppState>): Partial<AppState> {
  const step: Step = { ...stepOfAll(before, patch), cleared: true };
  return { ...patch, history: { past: [step], future: [], open: false } };
}

function stepOfAll(before: AppState, patch: Partial<AppState>): Step {
  const keys = Object.keys(patch) as (keyof AppState)[];
  return { kind: null, at: 0, back: pick(before, keys), edits: [], stage: null };
}

/** Goes back one step. */
export function undone(): Change {
  return (state) => {
    const { past, future } = state.history;
    const step = past.at(-1);
    if (!step) return {};
    const history = { past: past.slice(0, -1), future: [...future, inverse(step, state)], open: false };
    return { ...withStep(step, state), history };
  };
}

/** Redoes the last step that was undone. */
export function redone(): Change {
  return (state) => {
    const { past, future } = state.history;
    const step = future.at(-1);
    if (!step) return {};
    const history = { past: [...past, inverse(step, state)], future: future.slice(0, -1), open: false };
    return { ...withStep(step, state), history };
  };
}

function withStep({ back, edits, stage }: Step, state: AppState): Partial<AppState> {
  const after = { ...state, ...back };
  const { time, region } = after.playback;
  let { takes } = after;
  for (const { before, after: since } of edits)
    if (before) takes = withTake(takes, edited(takes, before));
    else takes = takes.filter(({ id }) => id !== since?.id);
  // The take that was on the stage may have been replaced by the next one or removed as the oldest: it comes back.
  if (stage && !back.takes && stage.reaction === after.reaction && !takes.some(sameAs(stage)))
    takes = withTake(takes, {
      ...edited(takes, stage),
      reaction: stage.reaction,
      createdAt: stage.createdAt,
    });
  const there = takes.some(({ id, reaction }) => id === after.other && reaction !== after.reaction);
  const reaction = after.reaction?.inputs.leader === after.leader ? after.reaction : null;
  return {
    ...back,
    takes,
    reaction,
    // A preview is frames within the reaction on the stage.
    ...(reaction !== state.reaction && { preview: null }),
    other: there ? after.other : null,
    compare: there ? after.compare : 'off',
    ...timelineWithin(state, { ...after, playback: { ...state.playback, time, region } }),
  };
}

function inverse(step: Step, state: AppState): Step {
  return {
    kind: null,
    at: 0,
    back: pick(state, Object.keys(step.back) as (keyof AppState)[]),
    ...(step.cleared && { cleared: true }),
    edits: step.edits.map(({ before, after }) => ({ before: after, after: before })),
    stage: takeOnStage(state),
  };
}

const sameAs = (stage: Take) => (take: Take) => take.reaction === stage.reaction;

/** The take with the name and the star of an earlier time and, if it is there, the motion of now. */
function edited(takes: readonly Take[], earlier: Take): Take {
  const now = takes.find(({ id }) => id === earlier.id);
  return now ? { ...now, name: earlier.name, starred: earlier.starred } : earlier;
}

function editsBetween(before: readonly Take[], after: readonly Take[]): Edit[] {
  if (before === after) return [];
  const earlier = new Map(before.map((take) => [take.id, take]));
  const edits: Edit[] = [];
  for (const take of after) {
    const old = earlier.get(take.id) ?? null;
    earlier.delete(take.id);
    if (old !== take) edits.push({ before: old, after: take });
  }
  for (const take of earlier.values()) edits.push({ before: take, after: null });
  return edits;
}

/** The inputs of a reaction that differ, by their names, which are the same in the state. */
function changedInputs(before: AppState, after: AppState): (keyof Inputs)[] {
  const inputs = currentInputs(before);
  // Before there is a leader there is nothing to go back to.
  if (!inputs) return [];
  return (Object.keys(inputs) as (keyof Inputs)[]).filter((key) => {
    if (key !== 'settings') return before[key] !== after[key];
    const [a, b] = [before.settings, after.settings];
    return a !== b && !(a && b && sameSettings(a, b));
  });
}

/** The names of the parts that changed: `leader`, or `settings.guidance`. */
function kindOf(parts: readonly (keyof AppState)[], before: AppState, after: AppState): string {
  return parts
    .map((key) => {
      if (key !== 'settings' || !before.settings || !after.settings) return key;
      const [a, b] = [before.settings, after.settings];
      const names = (Object.keys(b) as (keyof Settings)[]).filter(
        (name) => JSON.stringify(a[name]) !== JSON.stringify(b[name]),
      );
      return `settings.${names.join('+')}`;
    })
    .join(' ');
}

function isOfSettings(kind: string | null | undefined): boolean {
  return kind?.startsWith('settings.') ?? false;
}

function pick(state: AppState, keys: readonly (keyof AppState)[]): Partial<AppState> {
  return Object.fromEntries(keys.map((key) => [key, state[key]]));
}
