import type { Generator } from '../../model/client';
import {
  allVariationsMade,
  sameButSeed,
  variationInputs,
  variationAdded,
  variationProgressed,
  variationsStarted,
  variationsDropped,
  variationsResumed,
  variationsStopped,
} from '../store/actions/variations';
import { reactionOf, requestFor } from './generation';
import { generationProblem, isAbort } from '../store/problems';
import { sameInputs, upToDate, readyInputs } from '../store/selectors';
import type { Variation } from '../store/state';
import { reactionAdded } from '../store/actions/reaction';
import { randomSeed, seedRandomized, settingsSet } from '../store/actions/settings';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/**
 * Makes several reactions to pick from. The first is the one that `Generation` makes anyway; the others follow one
 * after the other. All are dropped when files or settings other than the seed change.
 */
export class VariationMaker {
  readonly #store: Store;
  readonly #model: () => Promise<Generator>;
  readonly #generate: () => void;
  readonly #unsubscribe: () => void;
  #controller: AbortController | null = null;

  /** @param generate makes the reaction to the present inputs, as `Services.generate` */
  constructor(store: Store, model: () => Promise<Generator>, generate: () => void) {
    this.#store = store;
    this.#model = model;
    this.#generate = generate;
    this.#unsubscribe = store.subscribe(() => {
      this.#follow();
    });
  }

  /** Makes three reactions that differ in their seed; where three are made already, three others. */
  readonly make = (): void => {
    const others = allVariationsMade(this.#store.getState().variations);
    if (others) {
      apply(this.#store, variationsDropped());
      apply(this.#store, seedRandomized(randomSeed()));
    }
    const inputs = readyInputs(this.#store.getState());
    if (!inputs) return;
    apply(this.#store, this.#store.getState().variations ? variationsResumed() : variationsStarted(inputs));
    const state = this.#store.getState();
    if (!upToDate(state) && (others || !state.job)) this.#generate();
    this.#follow();
    void this.#run();
  };

  /** Shows the variation with this seed on the stage. */
  readonly pick = (seed: number): void => {
    const { variations, reaction: shown } = this.#store.getState();
    const reaction = variations?.list.find((variation) => variation.seed === seed)?.reaction;
    if (!reaction || reaction === shown) return;
    apply(this.#store, settingsSet(reaction.inputs.settings));
    apply(this.#store, reactionAdded(reaction));
  };

  readonly cancel = (): void => {
    this.#abort();
    apply(this.#store, variationsStopped());
  };

  readonly dispose = (): void => {
    this.#unsubscribe();
    this.#abort();
  };

  #abort(): void {
    this.#controller?.abort();
    this.#controller = null;
  }

  /** Takes over what `Generation` has made, and drops the variations when their inputs have changed. */
  #follow(): void {
    const state = this.#store.getState();
    const { variations, reaction, job } = state;
    if (!variations) return;
    const inputs = readyInputs(state);
    const known = variations.list.find(({ seed }) => seed === inputs?.settings.seed);
    if (!inputs || !known || !sameButSeed(inputs, variations.inputs)) {
      this.#abort();
      apply(this.#store, variationsDropped());
    } else if (reaction && !known.reaction && sameInputs(reaction.inputs, inputs))
      apply(this.#store, variationAdded(known.seed, reaction));
    else if (job && !known.reaction && known.fraction !== job.fraction && variations.making)
      apply(this.#store, variationProgressed(known.seed, job.fraction));
  }

  /** Makes all that are missing, in order. */
  async #run(): Promise<void> {
    this.#abort();
    const controller = new AbortController();
    this.#controller = controller;
    const { signal } = controller;
    try {
      for (const variation of this.#store.getState().variations?.list ?? []) {
        if (variation.reaction) continue;
        if (this.#store.getState().settings?.seed !== variation.seed) await this.#makeOne(variation, signal);
        else if (!(await this.#madeByGeneration(variation.seed, signal))) break;
      }
    } catch (error) {
      if (!signal.aborted && !isAbort(error)) apply(this.#store, problemShown(generationProblem(error)));
    }
    if (this.#controller === controller) {
      this.#controller = null;
      apply(this.#store, variationsStopped());
    }
  }

  async #makeOne({ seed }: Variation, signal: AbortSignal): Promise<void> {
    const { variations } = this.#store.getState();
    if (!variations) return;
    const inputs = variationInputs(variations, seed);
    const generator = await this.#model();
    signal.throwIfAborted();
    const result = await generator.generate(requestFor(inputs, generator.manifest), {
      signal,
      onProgress: ({ fraction }) => {
        if (!signal.aborted) apply(this.#store, variationProgressed(seed, fraction));
      },
    });
    signal.throwIfAborted();
    apply(this.#store, variationAdded(seed, reactionOf(result, inputs)));
  }

  /** Resolves once `Generation` has made the reaction with this seed (true) or has given it up (false). */
  #madeByGeneration(seed: number, signal: AbortSignal): Promise<boolean> {
    return new Promise((resolve) => {
      const check = (): void => {
        const { variations, job } = this.#store.getState();
        const made = variations?.list.some((each) => each.seed === seed && each.reaction) ?? false;
        if (!made && job && !signal.aborted) return;
        unsubscribe();
        resolve(made);
      };
      const unsubscribe = this.#store.subscribe(check);
      check();
    });
  }
}
