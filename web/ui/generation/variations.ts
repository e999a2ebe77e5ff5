import type { Generator } from '../../model/client';
import {
  allVariationsMade,
  asksForVariations,
  candidateSeeds,
  seedsChosen,
  seedsTried,
  VARIATION_COUNT,
  variationInputs,
  variationAdded,
  variationProgressed,
  variationShown,
  variationsStarted,
  variationsDropped,
  variationsResumed,
  variationsStopped,
} from '../store/actions/variations';
import { firstVisitEnded } from '../store/actions/files';
import { reactionOf, requestFor } from './generation';
import { generationProblem, isAbort } from '../store/problems';
import { sameInputs, readyInputs } from '../store/selectors';
import { modelIdentity, sameModel, type Inputs, type Reaction } from '../store/reaction';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/** Time in which seeds are tried once there are enough of them, seconds. */
const CHOOSING_SECONDS = 8;

/**
 * Makes several reactions to pick from: samples the dances of more seeds, and finishes those that differ most one after
 * the other. All are dropped when files or settings other than seed and variety change.
 */
export class VariationMaker {
  readonly #store: Store;
  readonly #model: () => Promise<Generator>;
  readonly #unsubscribe: () => void;
  #controller: AbortController | null = null;

  constructor(store: Store, model: () => Promise<Generator>) {
    this.#store = store;
    this.#model = model;
    this.#unsubscribe = store.subscribe(() => {
      this.#dropOutdated();
    });
  }

  /** Makes three reactions that differ in their seed; where three are made already, three others. */
  readonly make = (): void => {
    const inputs = readyInputs(this.#store.getState());
    if (!inputs) return;
    const { variations } = this.#store.getState();
    const goesOn = variations && !allVariationsMade(variations);
    apply(this.#store, firstVisitEnded());
    apply(this.#store, goesOn ? variationsResumed() : variationsStarted(inputs));
    void this.#run();
  };

  /** Shows the variation with this seed on the stage. */
  readonly pick = (seed: number): void => {
    const { variations, reaction: shown } = this.#store.getState();
    const reaction = variations?.list.find((variation) => variation.seed === seed)?.reaction;
    if (!reaction || reaction === shown) return;
    apply(this.#store, variationShown(reaction));
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

  #dropOutdated(): void {
    const state = this.#store.getState();
    const inputs = readyInputs(state);
    if (state.variations && inputs && asksForVariations(inputs, state.variations)) return;
    this.#abort();
    if (state.variations) apply(this.#store, variationsDropped());
  }

  async #run(): Promise<void> {
    this.#abort();
    const controller = new AbortController();
    this.#controller = controller;
    const { signal } = controller;
    try {
      // What is asked for first is answered first, and may be one of these reactions.
      await this.#jobEnded(signal);
      await this.#finish(await this.#chosenSeeds(signal), signal);
    } catch (error) {
      if (!signal.aborted && !isAbort(error)) apply(this.#store, problemShown(generationProblem(error)));
    }
    if (this.#controller === controller) {
      this.#controller = null;
      apply(this.#store, variationsStopped());
    }
  }

  /** Chooses the seeds, unless they are chosen. */
  async #chosenSeeds(signal: AbortSignal): Promise<readonly number[]> {
    const { variations } = this.#store.getState();
    if (!variations) return [];
    const known = variations.list.flatMap(({ seed }) => seed ?? []);
    if (known.length > 0) return known;
    const generator = await this.#model();
    signal.throwIfAborted();
    const seeds = await generator.differingSeeds(
      {
        request: requestFor(variations.inputs, generator.manifest),
        seeds: candidateSeeds(variations),
        count: VARIATION_COUNT,
        seconds: CHOOSING_SECONDS,
      },
      {
        signal,
        onProgress: (share) => {
          if (!signal.aborted) apply(this.#store, seedsTried(share));
        },
      },
    );
    signal.throwIfAborted();
    apply(this.#store, seedsChosen(seeds));
    return seeds;
  }

  /** Finishes all that are missing, in order. */
  async #finish(seeds: readonly number[], signal: AbortSignal): Promise<void> {
    for (const seed of seeds) {
      const { variations } = this.#store.getState();
      if (!variations || variations.list.some((each) => each.seed === seed && each.reaction)) continue;
      const inputs = variationInputs(variations, seed);
      const reaction = this.#known(inputs) ?? (await this.#makeOne(inputs, signal));
      apply(this.#store, variationAdded(seed, reaction));
    }
  }

  /** A reaction of this model to these inputs that is there already. */
  #known(inputs: Inputs): Reaction | undefined {
    const { reaction: shown, takes, manifest } = this.#store.getState();
    const model = manifest ? modelIdentity(manifest) : undefined;
    const known = [...(shown ? [shown] : []), ...takes.map(({ reaction }) => reaction)];
    return known.find(
      (made) => made.latents !== null && sameModel(made.model, model) && sameInputs(made.inputs, inputs),
    );
  }

  async #makeOne(inputs: Inputs, signal: AbortSignal): Promise<Reaction> {
    const generator = await this.#model();
    signal.throwIfAborted();
    const result = await generator.generate(requestFor(inputs, generator.manifest), {
      signal,
      onProgress: ({ fraction }) => {
        if (!signal.aborted) apply(this.#store, variationProgressed(inputs.settings.seed, fraction));
      },
    });
    signal.throwIfAborted();
    return reactionOf(result, inputs, generator.manifest);
  }

  /** Resolves once no job is under way. */
  #jobEnded(signal: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
      const check = (): void => {
        if (this.#store.getState().job && !signal.aborted) return;
        unsubscribe();
        signal.removeEventListener('abort', check);
        if (signal.aborted) reject(signal.reason as Error);
        else resolve();
      };
      const unsubscribe = this.#store.subscribe(check);
      signal.addEventListener('abort', check);
      check();
    });
  }
}
