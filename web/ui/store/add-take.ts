import { differOnlyInWeights, sameInputs } from './selectors';
import { sameModel, type Reaction, type Take } from './reaction';
import type { AppState } from './state';
import { sealed, withoutCleared } from './history/history';
import { currentInputs, takeOnStage, takeTitle, withTake } from './take';

/** Identity and creation time of a new take, the latter in milliseconds since 1970. */
export interface TakeStamp {
  readonly id: string;
  readonly at: number;
}

/**
 * Most time between two reactions that belong together although no drag says so, as when a fader is moved by keys. After
 * a longer rest the visitor has looked at the earlier one, which therefore stays.
 */
const SAME_CHANGE_MS = 4000;

/** Most takes in the list; beyond it the oldest that are neither starred nor named are removed. */
export const MAX_TAKES = 40;

export function newStamp(): TakeStamp {
  const at = Date.now();
  return { id: `${at.toString(36)}-${Math.random().toString(36).slice(2, 8)}`, at };
}

/** The takes after a reaction has been generated or loaded. It is one of three things, tested in this order. */
export function withReaction(
  state: AppState,
  reaction: Reaction,
  stamp: TakeStamp,
): Pick<AppState, 'takes' | 'takesMade' | 'history' | 'drag' | 'toast'> {
  const { takes, takesMade, drag, toast } = state;
  const before = takeOnStage(state);
  // A drag stays one step of undo however many reactions come while it lasts.
  const sameDance =
    before !== null &&
    sameModel(before.reaction.model, reaction.model) &&
    differOnlyInWeights(before.reaction.inputs, reaction.inputs);
  const history = sameDance ? state.history : sealed(state.history);
  const goingOn = dragAfter(state, reaction);
  const dragged = (take: string | null): AppState['drag'] => goingOn && { ...goingOn, take };
  const keep = (take: Take): ReturnType<typeof withReaction> => ({
    takes: withTake(takes, take),
    takesMade,
    history,
    drag: dragged(take.id),
    toast,
  });

  // 1. The same inputs as a take's: the model generates the same motion, so it is that take again. A drag that came
  // there leaves nothing of its own.
  const sameInput = takes.find((take) => isSameAgain(take.reaction, reaction));
  if (sameInput) {
    const kept = keep({ ...sameInput, reaction });
    const onTheWay = drag && before && before !== sameInput && isReplaceable(before, state, stamp.at);
    if (!onTheWay) return sameInput.id === drag?.take ? kept : { ...kept, drag: dragged(null) };
    return { ...kept, takes: kept.takes.filter(({ id }) => id !== before.id), drag: dragged(null) };
  }

  // 2. The next reaction of a drag or of keys replaces the one before.
  if (before && sameDance && isReplaceable(before, state, stamp.at))
    return keep({ ...before, createdAt: stamp.at, reaction });

  // 3. A new take. The page's own reactions have a label and need no number.
  const number = reaction.label === null ? takesMade + 1 : 0;
  const take: Take = { id: stamp.id, number, name: null, starred: false, createdAt: stamp.at, reaction };
  const oldest = tooOld(withTake(takes, take), [take.id, state.other]);
  return {
    takes: withTake(takes, take).filter((one) => !oldest.includes(one)),
    takesMade: Math.max(takesMade, number),
    // Nobody has asked for a reaction that comes on a first visit, so it is no reason to lose what can be undone.
    history: reaction.label === null && !state.firstVisit ? withoutCleared(history) : history,
    drag: dragged(take.id),
    toast: oldest.length > 0 ? { text: removedText(oldest) } : toast,
  };
}

/** The drag where it goes on: it ends with the reaction to where it was released; one to the way there may come before. */
function dragAfter(state: AppState, reaction: Reaction): AppState['drag'] {
  const { drag } = state;
  if (!drag || drag.held) return drag;
  return sameInputs(reaction.inputs, currentInputs(state)) ? null : drag;
}

/** Whether both are of the same inputs, made by the same model or ready-made. */
function isSameAgain(made: Reaction, reaction: Reaction): boolean {
  const sameOrigin = made.label === reaction.label && sameModel(made.model, reaction.model);
  return sameOrigin && sameInputs(made.inputs, reaction.inputs);
}

/**
 * Whether a take may be replaced by one that differs from it only in weights: it is not starred, named or in a
 * comparison, it was generated here, and by the same drag or, without one, not longer ago than `SAME_CHANGE_MS`. The clock
 * may have been set back since, or that of another computer be ahead.
 */
function isReplaceable(take: Take, { other, drag }: AppState, now: number): boolean {
  const unmarked = !take.starred && take.name === null && take.id !== other && take.reaction.label === null;
  return unmarked && (drag ? take.id === drag.take : Math.abs(now - take.createdAt) < SAME_CHANGE_MS);
}

/** The oldest takes beyond `MAX_TAKES` that are neither starred nor named nor in use. */
function tooOld(takes: readonly Take[], inUse: readonly (string | null)[]): readonly Take[] {
  const surplus = Math.max(0, takes.length - MAX_TAKES);
  return takes
    .filter(({ id, starred, name }) => !starred && name === null && !inUse.includes(id))
    .toReversed()
    .slice(0, surplus);
}

function removedText(takes: readonly Take[]): string {
  const names = takes.map((take) => `“${takeTitle(take)}”`).join(' and ');
  return `${names} left the list, which holds ${MAX_TAKES} takes. Star or name a take to keep it.`;
}
