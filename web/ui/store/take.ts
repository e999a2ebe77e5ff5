import { capitalised } from './format';
import { readyInputs } from './selectors';
import type { Inputs, Reaction, Take } from './reaction';
import type { AppState, Letter } from './state';

/** What a reaction would be generated from, also while a file is being read; null without a leader or settings. */
export function currentInputs(state: AppState): Inputs | null {
  return readyInputs({ ...state, reading: { song: null, leader: null } });
}

/** The take whose reaction is on the stage; null for a reaction whose take was deleted. */
export function takeOnStage({ takes, reaction }: Pick<AppState, 'takes' | 'reaction'>): Take | null {
  return takes.find((take) => take.reaction === reaction) ?? null;
}

/** Why two reactions can't be compared, in a sentence; null when they can. */
export function whyNotComparable(one: Reaction, other: Reaction): string | null {
  if (one.inputs.leader !== other.inputs.leader) return 'This take was made for another leader.';
  return one.inputs.settings.role === other.inputs.settings.role ? null : 'This take dances the other role.';
}

/** Whether a take can be compared with the one on the stage: another one, of the same part to the same leader. */
export function comparable({ reaction }: Take, { reaction: shown }: Pick<AppState, 'reaction'>): boolean {
  return shown !== null && reaction !== shown && whyNotComparable(reaction, shown) === null;
}

/**
 * The take that the one on the stage is compared with. One that can't be, as when something is undone or another
 * leader has come, waits until it can.
 */
export function otherTake(state: Pick<AppState, 'takes' | 'other' | 'reaction'>): Take | null {
  return state.takes.find((take) => take.id === state.other && comparable(take, state)) ?? null;
}

/** The letter of the take on the stage; without another one it is A. */
export function stageLetter(state: AppState): Letter {
  return otherTake(state) ? state.letter : 'A';
}

/** The letter that a take has in the comparison, if any. */
export function letterOf(take: Take, state: AppState): Letter | null {
  if (take.reaction === state.reaction) return stageLetter(state);
  return take === otherTake(state) ? otherLetter(state.letter) : null;
}

export function otherLetter(letter: Letter): Letter {
  return letter === 'A' ? 'B' : 'A';
}

/** `Softer hands` when it was named so, else `Demo reaction` or `Take 3`. */
export function takeTitle({
  name,
  number,
  reaction,
}: Pick<Take, 'name' | 'number'> & { readonly reaction: Pick<Reaction, 'label'> }): string {
  if (name !== null) return name;
  const { label } = reaction;
  return label ? capitalised(label) : `Take ${number}`;
}

/** The order in which takes are listed. */
export function newestFirst(
  a: Pick<Take, 'createdAt' | 'number'>,
  b: Pick<Take, 'createdAt' | 'number'>,
): number {
  return b.createdAt - a.createdAt || b.number - a.number;
}

/** Replaces the take with the same id, or adds the take in order of age, the newest first. */
export function withTake(takes: readonly Take[], take: Take): readonly Take[] {
  if (takes.some(({ id }) => id === take.id)) return takes.map((old) => (old.id === take.id ? take : old));
  return [...takes, take].sort(newestFirst);
}

/**
 * The takes of this page together with those that another tab has stored in the meantime, each as it was changed last.
 * @param synced this page's takes as they were last stored or restored here: those that are still the same objects are
 *   unchanged
 */
export function mergedTakes(
  here: readonly Take[],
  synced: readonly Take[],
  stored: readonly Take[],
): readonly Take[] {
  const changed = here.filter((take) => !synced.includes(take));
  const deleted = synced.filter(({ id }) => !here.some((take) => take.id === id));
  return stored
    .filter(({ id }) => ![...changed, ...deleted].some((take) => take.id === id))
    .reduce(withTake, changed);
}

/** The takes, each with a number of its own: of two with the same one the newer gets the next that is free. */
export function withOwnNumbers(takes: readonly Take[]): readonly Take[] {
  let last = Math.max(0, ...takes.map(({ number }) => number));
  const isNewer = (a: Take, b: Take): boolean => (newestFirst(a, b) || (a.id > b.id ? -1 : 1)) < 0;
  // The page's own reactions have none.
  const isDoubled = (take: Take): boolean =>
    take.number > 0 &&
    takes.some((other) => other !== take && other.number === take.number && isNewer(take, other));
  // From the oldest on.
  return takes
    .toReversed()
    .map((take) => (isDoubled(take) ? { ...take, number: ++last } : take))
    .toReversed();
}

/**
 * The takes for another model: without their latents, which it can't decode, and without their songs if its audio
 * recipe differs.
 */
export function takesForOtherModel({ takes, reaction }: AppState, sameRecipe: boolean): Partial<AppState> {
  const forget = (made: Reaction): Reaction => ({
    ...made,
    latents: null,
    inputs: sameRecipe ? made.inputs : { ...made.inputs, song: null },
  });
  const kept = takes.map((take) => ({ ...take, reaction: forget(take.reaction) }));
  const shown = takes.findIndex((take) => take.reaction === reaction);
  return { takes: kept, reaction: kept[shown]?.reaction ?? (reaction && forget(reaction)) };
}
