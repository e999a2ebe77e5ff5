import { newStamp } from '../add-take';
import { clampedToStep } from '../guidance-matrix';
import { withUndo } from '../history/history';
import { sameInputs } from '../selectors';
import type { Inputs, Reaction } from '../reaction';
import type { AppState, Variations } from '../state';
import type { Change } from '../store';
import { reactionAdded } from './reaction';

/** How many reactions there are to choose from. */
export const VARIATION_COUNT = 3;

/** How many seeds are tried for them. */
const CANDIDATE_COUNT = 6;

/**
 * By how much their variety is above the one that is set: seeds of the shipped model are 44 mm apart at 1 and 60 mm at
 * 1.5 (mean over the joints of the demo), whichever of them are chosen.
 */
const MORE_VARIETY = 0.6;

/** Progress of a variation when its seed is chosen; after that it is decoded and solved. */
const CHOSEN_FRACTION = 0.7;

/** Whether these inputs differ from those of the variations in nothing but seed and variety. */
export function asksForVariations(inputs: Inputs, variations: Variations): boolean {
  const { seed, variety } = inputs.settings;
  const { inputs: theirs } = variations;
  return sameInputs(inputs, { ...theirs, settings: { ...theirs.settings, seed, variety } });
}

/** The inputs of one variation. */
export function variationInputs({ inputs }: Variations, seed: number): Inputs {
  return { ...inputs, settings: { ...inputs.settings, seed } };
}

/** The seeds that are tried: consecutive ones; after the largest comes 0. */
export function candidateSeeds({ firstSeed }: Variations): number[] {
  return Array.from({ length: CANDIDATE_COUNT }, (_, i) => (firstSeed + i) % 2 ** 32);
}

/** Variations of these inputs; after others of the same inputs with the seeds that come next. */
export function variationsStarted({ settings, ...files }: Inputs): Change {
  return ({ variations: before, manifest }) => {
    if (!manifest) return {};
    // A picked variation has set the variety that is already above the visitor's.
    const isRaised = before?.inputs.settings.variety === settings.variety;
    const variety = isRaised
      ? settings.variety
      : clampedToStep(settings.variety + MORE_VARIETY, manifest.guidance.variety);
    return {
      variations: {
        inputs: { ...files, settings: { ...settings, variety } },
        firstSeed: before ? (before.firstSeed + CANDIDATE_COUNT) % 2 ** 32 : settings.seed,
        list: Array.from({ length: VARIATION_COUNT }, () => ({ seed: null, reaction: null, fraction: 0 })),
        making: true,
      },
    };
  };
}

/** Generating the missing ones goes on. */
export function variationsResumed(): Change {
  return changed((variations) => ({ ...variations, making: true }));
}

/** This share of the seeds, 0 to 1, has been tried. */
export function seedsTried(share: number): Change {
  return changed((variations) => ({
    ...variations,
    list: variations.list.map((variation) => ({ ...variation, fraction: share * CHOSEN_FRACTION })),
  }));
}

export function seedsChosen(seeds: readonly number[]): Change {
  return changed((variations) => ({
    ...variations,
    list: seeds.map((seed) => ({ seed, reaction: null, fraction: CHOSEN_FRACTION })),
  }));
}

/** @param fraction of the generation, 0 to 1, most of which was done when the seed was chosen */
export function variationProgressed(seed: number, fraction: number): Change {
  return changed((variations) => withVariation(variations, seed, Math.max(CHOSEN_FRACTION, fraction), null));
}

export function variationAdded(seed: number, reaction: Reaction): Change {
  return changed((variations) => withVariation(variations, seed, 1, reaction));
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

/** Shows a variation at once with its settings, so that nothing is generated for them; one step of undo. */
export function variationShown(reaction: Reaction): Change {
  const stamp = newStamp();
  return (state) => {
    const { settings } = reaction.inputs;
    const asked = { ...state, ...withUndo(state, { settings }, stamp.at) };
    return { settings, ...reactionAdded(reaction, stamp)(asked) };
  };
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
  fraction: number,
  reaction: Reaction | null,
): Variations {
  return {
    ...variations,
    list: variations.list.map((variation) =>
      variation.seed === seed ? { seed, fraction, reaction } : variation,
    ),
  };
}
