import { sameInputs } from './selectors';
import type { AppState, Inputs, Reaction, Take } from './state';
import { sealed } from './history';
import { takeOnStage, withTake } from './take';

/** What a new take gets from outside: an identity, and the time in milliseconds since 1970. */
export interface Stamp {
  readonly id: string;
  readonly at: number;
}

/**
 * While guidance is being dragged, reactions follow each other this fast, milliseconds. A longer rest means that the
 * visitor has looked at the one before.
 */
const SAME_DRAG_MS = 4000;

/** Takes that are kept; beyond it the oldest that nobody starred or named leave. */
export const MAX_TAKES = 40;

export function newStamp(): Stamp {
  const at = Date.now();
  return { id: `${at.toString(36)}-${Math.random().toString(36).slice(2, 8)}`, at };
}

/** The takes after a reaction has arrived. It is one of four things, asked in this order. */
export function withReaction(
  state: AppState,
  reaction: Reaction,
  stamp: Stamp,
): Pick<AppState, 'takes' | 'takesMade' | 'history'> {
  const { takes, takesMade } = state;
  const before = takeOnStage(state);
  // A drag stays one step of undo however many reactions come while it lasts.
  const live = before !== null && differOnlyInGuidance(before.reaction.inputs, reaction.inputs);
  const history = live ? state.history : sealed(state.history);
  const keep = (take: Take): Pick<AppState, 'takes' | 'takesMade' | 'history'> => ({
    takes: withTake(takes, take),
    takesMade,
    history,
  });

  // 1. The motion of a take, told anew what it was made from, as when the demo's song comes after its dancers.
  const told = takes.find((take) => take.reaction.motion === reaction.motion);
  if (told) return keep({ ...told, reaction });

  // 2. The same wish as a take's: the model answers alike, so that it is that take, made again.
  const again = takes.find(
    (take) => take.reaction.label === reaction.label && sameInputs(take.reaction.inputs, reaction.inputs),
  );
  if (again) return keep({ ...again, reaction });

  // 3. The next moment of a drag takes the place of the one before.
  if (before && live && isReplaceable(before, state, stamp.at))
    return keep({ ...before, createdAt: stamp.at, reaction });

  // 4. A take of its own. What the page brings along has a name and needs no number.
  const number = reaction.label === null ? takesMade + 1 : 0;
  const take: Take = { id: stamp.id, number, name: null, starred: false, createdAt: stamp.at, reaction };
  return {
    takes: withoutOldest(withTake(takes, take), [take.id, state.other]),
    takesMade: Math.max(takesMade, number),
    history,
  };
}

/**
 * Whether the take may give way to one that differs from it only in guidance: nobody has starred it, named it or
 * chosen it for a comparison, it was made here, and not longer ago than two reactions of one drag lie apart.
 */
function isReplaceable(take: Take, { other }: AppState, now: number): boolean {
  const ofNobody = !take.starred && take.name === null && take.id !== other && take.reaction.label === null;
  return ofNobody && now - take.createdAt < SAME_DRAG_MS;
}

function differOnlyInGuidance(a: Inputs, b: Inputs): boolean {
  const { guidance, music } = b.settings;
  return sameInputs({ ...a, settings: { ...a.settings, guidance, music } }, b);
}

/** At most `MOST_TAKES`, unless more are starred, named or in use. */
function withoutOldest(takes: readonly Take[], inUse: readonly (string | null)[]): readonly Take[] {
  let spare = takes.length - MAX_TAKES;
  if (spare <= 0) return takes;
  const leaving = new Set<string>();
  for (const { id, starred, name } of takes.toReversed())
    if (spare > 0 && !starred && name === null && !inUse.includes(id)) {
      leaving.add(id);
      spare--;
    }
  return takes.filter(({ id }) => !leaving.has(id));
}
