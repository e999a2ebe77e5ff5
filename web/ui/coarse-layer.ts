import type { Generator } from '../model/client';
import type { SolvedMotion } from '../motion/clip';
import { coarseProblem, isAbort } from './problems';
import type { AppState, Reaction } from './state';
import { apply, coarseChanged, shownToggled, told, watchAll, type Store } from './store';

/** Whether the reaction on the stage can't tell its coarse layer, since it was not made here. */
export const coarseIsMissing = ({ reaction }: Pick<AppState, 'reaction'>): boolean =>
  reaction !== null && reaction.latents === null;

/**
 * Decodes the coarse layer of the reaction on the stage when somebody wants to see it: once for each reaction, dropped
 * when another reaction takes its place.
 * @param model resolves with the model that makes the reactions
 * @returns how to stop
 */
export function createCoarseLayer(store: Store, model: () => Promise<Generator>): () => void {
  /** By the latents; they go when no reaction has them any more. */
  const known = new WeakMap<Float32Array, SolvedMotion>();
  let running: AbortController | null = null;

  const decode = async ({ inputs }: Reaction, latents: Float32Array): Promise<void> => {
    const controller = new AbortController();
    running = controller;
    const { signal } = controller;
    apply(store, coarseChanged({ decoding: true }));
    try {
      const generator = await model();
      const motion = await generator.coarse({ leader: inputs.leader.file.clip, latents }, { signal });
      known.set(latents, motion);
      if (!signal.aborted) apply(store, coarseChanged({ motion, decoding: false }));
    } catch (error) {
      if (signal.aborted) return;
      apply(store, coarseChanged({ motion: null, decoding: false }));
      if (isAbort(error)) return;
      apply(store, told(coarseProblem(error)));
      // Asked for again by hand, not by itself.
      if (store.getState().shown.ghost) apply(store, shownToggled('ghost'));
    }
  };

  const stop = watchAll(
    store,
    ({ reaction, shown }) => [reaction?.latents, shown.ghost],
    ({ reaction, shown, coarse }) => {
      running?.abort();
      running = null;
      const latents = reaction?.latents;
      const motion = latents && known.get(latents);
      if (reaction && latents && !motion && shown.ghost) void decode(reaction, latents);
      else if (coarse.decoding || coarse.motion !== (motion ?? null))
        apply(store, coarseChanged({ motion: motion ?? null, decoding: false }));
    },
  );
  return () => {
    stop();
    running?.abort();
  };
}
