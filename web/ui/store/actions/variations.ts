import { sameInputs } from '../selectors';
import type { AppState, Choices, Inputs, Reaction } from '../state';
import type { Change } from '../store';

/** How many reactions there are to pick from. */
export const CHOICES = 3;

/** Whether two wishes differ in nothing but the seed. */
export function sameButSeed(a: Inputs, b: Inputs): boolean {
  return sameInputs(a, { ...b, settings: { ...b.settings, seed: a.settings.seed } });
}

/** The wish for one of the choices. */
export function choiceInputs({ inputs }: Choices, seed: number): Inputs {
  return { ...inputs, settings: { ...inputs.settings, seed } };
}

/** Seeds that follow each other, the wished one first; past the largest they begin again at 0. */
export function choicesBegun(inputs: Inputs): Change {
  const list = Array.from({ length: CHOICES }, (_, i) => ({
    seed: (inputs.settings.seed + i) % 2 ** 32,
    reaction: null,
    fraction: 0,
  }));
  return () => ({ choices: { inputs, list, making: true } });
}

/** The missing ones are made again. */
export function choicesResumed(): Change {
  return changed((choices) => ({ ...choices, making: true }));
}

export function choiceProgressed(seed: number, fraction: number): Change {
  return changed((choices) => withChoice(choices, seed, { fraction }));
}

export function choiceMade(seed: number, reaction: Reaction): Change {
  return changed((choices) => withChoice(choices, seed, { reaction, fraction: 1 }));
}

/** No more are made; what is made stays to pick from. */
export function choicesStopped(): Change {
  return changed((choices) => ({
    ...choices,
    making: false,
    list: choices.list.map((choice) => (choice.reaction ? choice : { ...choice, fraction: 0 })),
  }));
}

export function choicesDropped(): Change {
  return ({ choices }) => (choices ? { choices: null } : {});
}

/** Whether all choices are there. */
export function complete(choices: Choices | null): boolean {
  return choices?.list.every(({ reaction }) => reaction !== null) ?? false;
}

function changed(next: (choices: Choices) => Choices): Change {
  return ({ choices }: AppState) => (choices ? { choices: next(choices) } : {});
}

function withChoice(choices: Choices, seed: number, change: Partial<Choices['list'][number]>): Choices {
  return {
    ...choices,
    list: choices.list.map((choice) => (choice.seed === seed ? { ...choice, ...change } : choice)),
  };
}
