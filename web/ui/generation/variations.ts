import type { Generator } from '../../model/client';
import {
  variationInputs,
  variationAdded,
  variationProgressed,
  variationsStarted,
  variationsDropped,
  variationsResumed,
  variationsStopped,
  allVariationsMade,
  sameButSeed,
} from '../store/actions/variations';
import { reactionOf, requestFor } from './generation';
import { generationProblem, isAbort } from '../store/problems';
import { sameInputs, upToDate, readyInputs } from '../store/selectors';
import type { Variation } from '../store/state';
import { reactionAdded } from '../store/actions/reaction';
import { seedRolled, settingsSet, rolledSeed } from '../store/actions/settings';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

export interface ChoiceMaker {
  /** Makes three reactions that differ in their seed; where three are there already, three others. */
  readonly make: () => void;
  /** Brings one of them to the stage. */
  readonly pick: (seed: number) => void;
  readonly cancel: () => void;
  readonly dispose: () => void;
}

/**
 * Several reactions to pick from. The first is the one that the page makes anyway; the others follow one after the
 * other, and go when files or settings ask for something else.
 * @param generate makes the reaction that is wanted now, as `Services.generate`
 */
export function createChoices(
  store: Store,
  model: () => Promise<Generator>,
  generate: () => void,
): ChoiceMaker {
  let controller: AbortController | null = null;

  const stop = (): void => {
    controller?.abort();
    controller = null;
  };

  /** Waits until the page has made the reaction on its own, or has given up on it. */
  const made = (seed: number, signal: AbortSignal): Promise<boolean> =>
    new Promise((resolve) => {
      const look = (): void => {
        const { variations, job } = store.getState();
        const there = variations?.list.some((choice) => choice.seed === seed && choice.reaction) ?? false;
        if (!there && job && !signal.aborted) return;
        unsubscribe();
        resolve(there);
      };
      const unsubscribe = store.subscribe(look);
      look();
    });

  const makeOne = async ({ seed }: Variation, signal: AbortSignal): Promise<void> => {
    const { variations } = store.getState();
    if (!variations) return;
    const inputs = variationInputs(variations, seed);
    const generator = await model();
    signal.throwIfAborted();
    const result = await generator.generate(requestFor(inputs, generator.manifest), {
      signal,
      onProgress: ({ fraction }) => {
        if (!signal.aborted) apply(store, variationProgressed(seed, fraction));
      },
    });
    signal.throwIfAborted();
    apply(store, variationAdded(seed, reactionOf(result, inputs)));
  };

  const run = async (): Promise<void> => {
    stop();
    const mine = (controller = new AbortController());
    const { signal } = mine;
    try {
      for (const choice of store.getState().variations?.list ?? []) {
        if (choice.reaction) continue;
        if (store.getState().settings?.seed !== choice.seed) await makeOne(choice, signal);
        else if (!(await made(choice.seed, signal))) break;
      }
    } catch (error) {
      if (!signal.aborted && !isAbort(error)) apply(store, problemShown(generationProblem(error)));
    }
    if (controller === mine) {
      controller = null;
      apply(store, variationsStopped());
    }
  };

  /** Takes in what the page made by itself, and lets go of what is not asked for any more. */
  const follow = (): void => {
    const state = store.getState();
    const { variations, reaction, job } = state;
    if (!variations) return;
    const wanted = readyInputs(state);
    const known = variations.list.find(({ seed }) => seed === wanted?.settings.seed);
    if (!wanted || !known || !sameButSeed(wanted, variations.inputs)) {
      stop();
      apply(store, variationsDropped());
    } else if (reaction && !known.reaction && sameInputs(reaction.inputs, wanted))
      apply(store, variationAdded(known.seed, reaction));
    else if (job && !known.reaction && known.fraction !== job.fraction && variations.making)
      apply(store, variationProgressed(known.seed, job.fraction));
  };
  const unsubscribe = store.subscribe(follow);

  const begin = (): void => {
    const others = allVariationsMade(store.getState().variations);
    if (others) {
      apply(store, variationsDropped());
      apply(store, seedRolled(rolledSeed()));
    }
    const wanted = readyInputs(store.getState());
    if (!wanted) return;
    apply(store, store.getState().variations ? variationsResumed() : variationsStarted(wanted));
    const state = store.getState();
    if (!upToDate(state) && (others || !state.job)) generate();
    follow();
    void run();
  };

  return {
    make: begin,
    pick: (seed) => {
      const reaction = store.getState().variations?.list.find((choice) => choice.seed === seed)?.reaction;
      if (!reaction || reaction === store.getState().reaction) return;
      apply(store, settingsSet(reaction.inputs.settings));
      apply(store, reactionAdded(reaction));
    },
    cancel: () => {
      stop();
      apply(store, variationsStopped());
    },
    dispose: () => {
      unsubscribe();
      stop();
    },
  };
}
