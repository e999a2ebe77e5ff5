import { counted } from '../format';
import { timelineWithin, upToDate } from '../selectors';
import type { Take } from '../reaction';
import type { AppState, Compare, Letter } from '../state';
import type { Change } from '../store';
import { comparable, whyNotComparable, otherLetter, otherTake, stageLetter, takeOnStage } from '../take';

/** Longest name of a take, characters. */
export const MAX_TAKE_NAME_LENGTH = 60;

/** Shows a take and restores the files and settings that it was generated from, so that nothing is generated anew. */
function withTakeShown(state: AppState, { id, reaction }: Take): Partial<AppState> {
  const { inputs } = reaction;
  const other = otherTake(state);
  const endsComparison = other ? whyNotComparable(other.reaction, reaction) !== null : id === state.other;
  return {
    ...inputs,
    reaction,
    ...timelineWithin(state, { ...state, ...inputs }),
    ...(endsComparison && { other: null, compare: 'off' }),
  };
}

/** Shows a take at the same playhead, under its own letter if it is the compared one, else under the present letter. */
export function takeChosen(id: string): Change {
  return (state) => {
    const take = state.takes.find((one) => one.id === id);
    if (!take || take.reaction === state.reaction) return {};
    if (take === otherTake(state)) return takesSwapped()(state);
    return withTakeShown(state, take);
  };
}

/**
 * Swaps the take on the stage and the other one. Without another one it is the newest take to the same leader.
 * Looking at one and the other is nothing to undo, unless settings that no take has yet would be lost.
 */
export function takesSwapped(): Change {
  return (state) => {
    const stage = takeOnStage(state);
    const other = comparisonTake(state);
    if (!stage || !other) return {};
    return {
      ...withTakeShown(state, other),
      other: stage.id,
      letter: otherLetter(stageLetter(state)),
      ...(upToDate(state) && { history: state.history }),
    };
  };
}

/** Whether there are two takes to swap. */
export function canSwapTakes(state: AppState): boolean {
  return takeOnStage(state) !== null && comparisonTake(state) !== null;
}

/** The other take of a comparison; before there is one, the newest that can be it. */
function comparisonTake(state: AppState): Take | null {
  return otherTake(state) ?? state.takes.find((take) => comparable(take, state)) ?? null;
}

/** Why a letter can't be given to a take, in a sentence; null when it can. */
export function whyNoLetter(take: Take, letter: Letter, state: AppState): string | null {
  if (letter === stageLetter(state)) return null;
  if (take.reaction !== state.reaction)
    return state.reaction && whyNotComparable(take.reaction, state.reaction);
  return comparisonTake(state) ? null : 'There is no other take to compare with.';
}

/** Gives a letter of the comparison to a take; given again to the compared take, ends the comparison. */
export function letterGiven(id: string, letter: Letter): Change {
  return (state) => {
    const take = state.takes.find((one) => one.id === id);
    if (!take) return {};
    const mine = stageLetter(state);
    const other = otherTake(state);
    if (take.reaction === state.reaction) {
      // The letter that it leaves goes to the other take; without one to the newest that can be compared.
      const left = comparisonTake(state);
      return left && letter !== mine ? { letter, other: left.id } : {};
    }
    if (letter === mine) {
      const before = takeOnStage(state);
      return { ...withTakeShown(state, take), ...(take === other && { other: before?.id ?? null }) };
    }
    if (!comparable(take, state)) return {};
    return take === other ? { other: null, compare: 'off' } : { other: id, letter: mine };
  };
}

/** Shows the compared take beside the one on the stage or as a ghost; chosen again, hides it. */
export function compareSet(compare: Exclude<Compare, 'off'>): Change {
  return (state) => {
    if (state.compare === compare) return { compare: 'off' };
    return otherTake(state) ? { compare } : {};
  };
}

/** Names a take; an empty name restores its number as its name. */
export function takeRenamed(id: string, name: string): Change {
  const clean = name.replace(/\s+/g, ' ').trim().slice(0, MAX_TAKE_NAME_LENGTH) || null;
  return ({ takes }) =>
    takes.some((take) => take.id === id && take.name !== clean)
      ? { takes: takes.map((take) => (take.id === id ? { ...take, name: clean } : take)) }
      : {};
}

export function takeStarred(id: string): Change {
  return ({ takes }) => ({
    takes: takes.map((take) => (take.id === id ? { ...take, starred: !take.starred } : take)),
  });
}

/** Whether `starredKept` would remove a take. */
export function hasTakesToClear(state: AppState): boolean {
  const kept = takesToKeep(state);
  return kept.some(({ starred }) => starred) && kept.length < state.takes.length;
}

/**
 * Removes all takes without a star and says how many. Was one of them on the stage, the newest starred one to the same
 * leader is shown; without one it stays.
 */
export function starredKept(): Change {
  return (state) => {
    if (!hasTakesToClear(state)) return {};
    const takes = takesToKeep(state);
    const shown = takeOnStage(state);
    const next = shown && !takes.includes(shown) ? takes.find(sameLeader(state)) : undefined;
    const count = state.takes.length - takes.length;
    const comparisonEnds = next !== undefined || !takes.some(({ id }) => id === state.other);
    return {
      takes,
      toast: { text: `${counted(count, 'take')} without a star removed. Undo brings them back.` },
      ...(next && withTakeShown(state, next)),
      ...(comparisonEnds && { other: null, compare: 'off' }),
    };
  };
}

/** The starred takes, and the one on the stage if none of them could be shown in its place. */
function takesToKeep(state: AppState): readonly Take[] {
  const shown = takeOnStage(state);
  const replaceable = state.takes.some((take) => take.starred && sameLeader(state)(take));
  return state.takes.filter((take) => take.starred || (take === shown && !replaceable));
}

const sameLeader =
  ({ leader }: AppState) =>
  ({ reaction }: Take): boolean =>
    reaction.inputs.leader === leader;

/** Deletes a take. Was it on the stage, the next one to the same leader is shown; without one the stage stays. */
export function takeDeleted(id: string): Change {
  return (state) => {
    const at = state.takes.findIndex((take) => take.id === id);
    const take = state.takes[at];
    if (!take) return {};
    const takes = state.takes.filter((one) => one !== take);
    const near = [...takes.slice(at), ...takes.slice(0, at).toReversed()];
    const next = near.find(sameLeader(state));
    const moves = take.reaction === state.reaction && next;
    return {
      takes,
      ...(moves && withTakeShown(state, next)),
      ...((state.other === id || (moves && next.id === state.other)) && { other: null, compare: 'off' }),
    };
  };
}
