import { sameInputs } from '../selectors';
import type { Inputs, Reaction } from '../reaction';
import type { AppState, Variations } from '../state';
import type { Change } from '../store';

/** How many reactions there are to choose from. */
export const VARIATION_COUNT = 3;

/** Whether two inputs differ in nothing but the seed. */
export function sameButSeed(a: Inputs, b: Inputs): boolean {
  return sameInputs(a, { ...b, settings: { ...b.settings, seed: a.settings.seed } });
}

/** The inputs of one variation. */
export function variationInputs({ inputs }: Variations, seed: number): Inputs {
  return { ...inputs, settings: { ...inputs.settings, seed } };
}

/** Consecutive seeds from that of the inputs; after the largest comes 0. */
export function variationsStarted(inputs: Inputs): Change {
  const list = Array.from({ length: VARIATION_COUNT }, (_, i) => ({
    seed: (inputs.settings.seed + i) % 2 ** 32,
    reaction: null,
    fraction: 0,
  }));
  return () => ({ variations: { inputs, list, making: true } });
}

/** Generating the missing ones goes on. */
export function variationsResumed(): Change {
  return changed((variations) => ({ ...variations, making: true }));
}

export function variationProgressed(seed: number, fraction: number): Change {
  return changed((variations) => withVariation(variations, seed, { fraction }));
}

export function variationAdded(seed: number, reaction: Reaction): Change {
  return changed((variations) => withVariation(variations, seed, { reaction, fraction: 1 }));
}

/** Generating stops; those that are there stay. */
export function variationsStopped(): Change {
  return changed((variations) => ({
    ...variations,
    making: false,
    list: variations.list.map((variation) =>
      variation.reaction ? variation : { ...variation, fraction: 0 },
    ),
  }));
}

export function variationsDropped(): Change {
  return ({ variations }) => (variations ? { variations: null } : {});
}

/** Whether all variations are there. */
export function allVariationsMade(variations: Variations | null): boolean {
  return variations?.list.every(({ reaction }) => reaction !== null) ?? false;
}

function changed(next: (variations: Variations) => Variations): Change {
  return ({ variations }: AppState) => (variations ? { variations: next(variations) } : {});
}

function withVariation(
  variations: Variations,
  seed: number,
  change: Partial<Variations['list'][number]>,
): Variations {
  return {
    ...variations,
    list: variations.list.map((variation) =>
      variation.seed === seed ? { ...variation, ...change } : variation,
    ),
  };
}
