import { sameInputs } from '../selectors';
import type { AppState, Variations, Inputs, Reaction } from '../state';
import type { Change } from '../store';

/** How many reactions there are to pick from. */
export const VARIATION_COUNT = 3;

/** Whether two wishes differ in nothing but the seed. */
export function sameButSeed(a: Inputs, b: Inputs): boolean {
  return sameInputs(a, { ...b, settings: { ...b.settings, seed: a.settings.seed } });
}

/** The wish for one of the choices. */
export function variationInputs({ inputs }: Variations, seed: number): Inputs {
  return { ...inputs, settings: { ...inputs.settings, seed } };
}

/** Seeds that follow each other, the wished one first; past the largest they begin again at 0. */
export function variationsStarted(inputs: Inputs): Change {
  const list = Array.from({ length: VARIATION_COUNT }, (_, i) => ({
    seed: (inputs.settings.seed + i) % 2 ** 32,
    reaction: null,
    fraction: 0,
  }));
  return () => ({ variations: { inputs, list, making: true } });
}

/** The missing ones are made again. */
export function variationsResumed(): Change {
  return changed((choices) => ({ ...choices, making: true }));
}

export function variationProgressed(seed: number, fraction: number): Change {
  return changed((choices) => withVariation(choices, seed, { fraction }));
}

export function variationAdded(seed: number, reaction: Reaction): Change {
  return changed((choices) => withVariation(choices, seed, { reaction, fraction: 1 }));
}

/** No more are made; what is made stays to pick from. */
export function variationsStopped(): Change {
  return changed((choices) => ({
    ...choices,
    making: false,
    list: choices.list.map((choice) => (choice.reaction ? choice : { ...choice, fraction: 0 })),
  }));
}

export function variationsDropped(): Change {
  return ({ variations }) => (variations ? { variations: null } : {});
}

/** Whether all choices are there. */
export function allVariationsMade(choices: Variations | null): boolean {
  return choices?.list.every(({ reaction }) => reaction !== null) ?? false;
}

function changed(next: (choices: Variations) => Variations): Change {
  return ({ variations }: AppState) => (variations ? { variations: next(variations) } : {});
}

function withVariation(
  choices: Variations,
  seed: number,
  change: Partial<Variations['list'][number]>,
): Variations {
  return {
    ...choices,
    list: choices.list.map((choice) => (choice.seed === seed ? { ...choice, ...change } : choice)),
  };
}
