import { readyInputs } from './selectors';
import type { AppState, Inputs, Letter, Reaction, Take } from './state';

/** What a reaction would be made from, also while a file is being read; null without a leader or settings. */
export function currentInputs(state: AppState): Inputs | null {
  return readyInputs({ ...state, reading: { song: null, leader: null } });
}

/** The take whose reaction is on the stage; null for a reaction whose take was deleted. */
export function takeOnStage({ takes, reaction }: Pick<AppState, 'takes' | 'reaction'>): Take | null {
  return takes.find((take) => take.reaction === reaction) ?? null;
}

/** Why two reactions can't be compared, in a sentence; null when they can. */
export function whyNotComparable(one: Reaction, other: Reaction): string | null {
  if (one.inputs.leader !== other.inputs.leader) return 'Made for another leader.';
  return one.inputs.settings.role === other.inputs.settings.role ? null : 'Dances the other part.';
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
export function takeTitle({ name, number, reaction }: Take): string {
  if (name !== null) return name;
  const { label } = reaction;
  return label ? label.charAt(0).toUpperCase() + label.slice(1) : `Take ${number}`;
}

/** Puts a take in the place of the one with its id, or where its age puts it: the newest first. */
export function withTake(takes: readonly Take[], take: Take): readonly Take[] {
  if (takes.some(({ id }) => id === take.id)) return takes.map((old) => (old.id === take.id ? take : old));
  return [...takes, take].sort((a, b) => b.createdAt - a.createdAt || b.number - a.number);
}

/**
 * The takes as another model can go on with: they forget their latents, which mean nothing to it, and their songs
 * if it hears in another way.
 */
export function takesForOtherModel({ takes, reaction }: AppState, hearsAlike: boolean): Partial<AppState> {
  const strange = (made: Reaction): Reaction => ({
    ...made,
    latents: null,
    inputs: hearsAlike ? made.inputs : { ...made.inputs, song: null },
  });
  const kept = takes.map((take) => ({ ...take, reaction: strange(take.reaction) }));
  const shown = takes.findIndex((take) => take.reaction === reaction);
  return { takes: kept, reaction: kept[shown]?.reaction ?? (reaction && strange(reaction)) };
}
