import type { Generator } from '../model/client';
import { generationProblem, isAbort } from './problems';
import { guidanceMatrix, sameInputs, wantedInputs } from './selectors';
import type { Inputs } from './state';
import { apply, jobChanged, told, reacted, type Store } from './store';

/** Stillness after the last change before a new reaction is begun, milliseconds. */
const STILLNESS = 60;

export interface Generation {
  /** Makes the reaction now, whether or not anything has changed. */
  readonly generate: () => void;
  /** Stops what is being made; nothing begins again until something changes or is asked for. */
  readonly cancel: () => void;
  readonly dispose: () => void;
}

/**
 * Keeps the reaction in step with song, leader and settings: what they ask for is made by itself, once, and a
 * newer wish drops the older one. Whatever was on the stage stays there until the new reaction is ready.
 * @param model resolves with the model when it is there; rejects when it cannot be had, which is told elsewhere
 */
export function createGeneration(store: Store, model: () => Promise<Generator>): Generation {
  /** The last wish that was answered, is being answered, failed or was cancelled: it is not begun again. */
  let asked: Inputs | null = null;
  let running: { readonly controller: AbortController; readonly inputs: Inputs } | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const stop = (): void => {
    clearTimeout(timer);
    running?.controller.abort();
    running = null;
  };

  const begin = async (inputs: Inputs): Promise<void> => {
    stop();
    asked = inputs;
    const controller = new AbortController();
    running = { controller, inputs };
    const { signal } = controller;
    try {
      apply(store, jobChanged({ stage: 'waiting', done: 0, total: 1, fraction: 0 }));
      const generator = await model();
      if (signal.aborted) return;
      const { song, leader, settings } = inputs;
      const { motion, seconds } = await generator.generate(
        {
          leader: leader.file.clip,
          music: song ? { features: song.data.features, frames: song.data.frames } : null,
          guidance: guidanceMatrix(settings, generator.manifest.latent),
          steps: settings.steps,
          seed: settings.seed,
        },
        {
          signal,
          onProgress: (progress) => {
            if (!signal.aborted) apply(store, jobChanged(progress));
          },
        },
      );
      if (signal.aborted) return;
      running = null;
      const took = Object.values(seconds).reduce((sum, part) => sum + part, 0);
      apply(store, reacted({ motion, inputs, label: null, seconds: took }));
    } catch (error) {
      if (signal.aborted) return;
      running = null;
      apply(store, jobChanged(null));
      const failedToLoad = store.getState().model.phase === 'failed';
      if (!isAbort(error) && !failedToLoad) apply(store, told(generationProblem(error)));
    }
  };

  const consider = (): void => {
    const state = store.getState();
    const wanted = wantedInputs(state);
    if (!wanted) return;
    if (state.reaction && sameInputs(wanted, state.reaction.inputs)) {
      // On the stage already; what else was begun or about to begin is not wanted any more.
      asked = wanted;
      clearTimeout(timer);
      if (running && !sameInputs(running.inputs, wanted)) {
        stop();
        apply(store, jobChanged(null));
      }
      return;
    }
    if (sameInputs(wanted, asked)) return;
    asked = wanted;
    clearTimeout(timer);
    timer = setTimeout(() => {
      void begin(wanted);
    }, STILLNESS);
  };

  const unsubscribe = store.subscribe(consider);
  return {
    generate: () => {
      const wanted = wantedInputs(store.getState());
      if (wanted) void begin(wanted);
    },
    cancel: () => {
      stop();
      apply(store, jobChanged(null));
    },
    dispose: () => {
      unsubscribe();
      stop();
    },
  };
}
