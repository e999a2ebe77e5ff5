import { sameInputs } from '../selectors';
import type { AppState, Variations, Inputs, Reaction } from '../state';
import type { Change } from '../store';

/** How many variations are made. */
export const VARIATION_COUNT = 3;

/** Whether two inputs differ in nothing but the seed. */
export function sameExceptSeed(a: Inputs, b: Inputs): boolean {
  return sameInputs(a, { ...b, settings: { ...b.settings, seed: a.settings.seed } });
}

/** The inputs that the variation with this seed is made from. */
export function variationInputs({ inputs }: Variations, seed: number): Inputs {
  return { ...inputs, settings: { ...inputs.settings, seed } };
}

/** Seeds that follow each other, the one that is set first; past the largest they begin again at 0. */
export function variationsBegun(inputs: Inputs): Change {
  const list = Array.from({ length: VARIATION_COUNT }, (_, i) => ({
    seed: (inputs.settings.seed + i) % 2 ** 32,
    reaction: null,
    fraction: 0,
  }));
  return () => ({ variations: { inputs, list, making: true } });
}

/** The missing ones are made again. */
export function variationsResumed(): Change {
  return changed((variations) => ({ ...variations, making: true }));
}

export function variationProgressed(seed: number, fraction: number): Change {
  return changed((variations) => withVariation(variations, seed, { fraction }));
}

export function variationMade(seed: number, reaction: Reaction): Change {
  return changed((variations) => withVariation(variations, seed, { reaction, fraction: 1 }));
}

/** No more are made; what is made stays to pick from. */
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

/** Whether all variations are made. */
export function allMade(variations: Variations | null): boolean {
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
