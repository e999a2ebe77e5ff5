import { guidanceWords } from '../guidance-matrix';
import { wantedInputs } from '../selectors';
import type { AppState, Inputs, Letter, Reaction, Take } from '../state';

/** What a reaction would be made from, also while a file is being read; null without a leader or settings. */
export function presentInputs(state: AppState): Inputs | null {
  return wantedInputs({ ...state, reading: { song: null, leader: null } });
}

/** The take whose reaction is on the stage; null for a reaction whose take was deleted. */
export function takeOnStage({ takes, reaction }: Pick<AppState, 'takes' | 'reaction'>): Take | null {
  return takes.find((take) => take.reaction === reaction) ?? null;
}

/** The take that the one on the stage is compared with. */
export function otherTake({ takes, other }: Pick<AppState, 'takes' | 'other'>): Take | null {
  return takes.find(({ id }) => id === other) ?? null;
}

/** The letter that a take has in the comparison, if any. */
export function letterOf(take: Take, state: AppState): Letter | null {
  if (take.reaction === state.reaction) return state.letter;
  return take.id === state.other ? opposite(state.letter) : null;
}

export function opposite(letter: Letter): Letter {
  return letter === 'A' ? 'B' : 'A';
}

/** `Softer hands` when it was named so, else `Demo reaction` or `Take 3`. */
export function takeTitle({ name, number, reaction }: Take): string {
  if (name !== null) return name;
  const { label } = reaction;
  return label ? label.charAt(0).toUpperCase() + label.slice(1) : `Take ${number}`;
}

/**
 * What a take was made from, first what sets it apart from the page as it is now and from the model's own steps:
 * `as leader, song 1.7 s later, 6 steps, 1.20 coarse, 0.60 fine, 3.00 music, seed 1204`.
 */
export function takeWords({ reaction: { inputs } }: Take, state: AppState): string {
  const { leader, song, settings, shift } = inputs;
  const later = shift / leader.file.clip.fps;
  return [
    ...(leader === state.leader ? [] : [`to ${leader.name}`]),
    ...(song === state.song ? [] : [song?.name ?? 'no song']),
    ...(settings.role === 'leader' ? ['as leader'] : []),
    ...(shift === 0 ? [] : [`song ${Math.abs(later).toFixed(1)} s ${later > 0 ? 'later' : 'earlier'}`]),
    ...(settings.steps === state.manifest?.diffusion.steps.default ? [] : [`${settings.steps} steps`]),
    guidanceWords(settings),
    `seed ${settings.seed}`,
  ].join(', ');
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
export function ofAnotherModel({ takes, reaction }: AppState, hearsAlike: boolean): Partial<AppState> {
  const strange = (made: Reaction): Reaction => ({
    ...made,
    latents: null,
    inputs: hearsAlike ? made.inputs : { ...made.inputs, song: null },
  });
  const kept = takes.map((take) => ({ ...take, reaction: strange(take.reaction) }));
  const shown = takes.findIndex((take) => take.reaction === reaction);
  return { takes: kept, reaction: kept[shown]?.reaction ?? (reaction && strange(reaction)) };
}
