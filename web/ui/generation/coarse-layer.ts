import { RecentCache } from '../../common/recent-cache';
import type { Generator } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { coarseProblem, isAbort } from '../store/problems';
import type { Reaction } from '../store/reaction';
import { cacheLocked } from '../store/reactor-motion';
import type { AppState } from '../store/state';
import { apply, watchAll, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { coarseChanged, overlayToggled } from '../store/actions/view';
import { otherTake } from '../store/take';
import { requestFor } from './generation';

/** Coarse layers that are kept: those of the two takes that are drawn, and of the two before them. */
const MOST_DECODED = 4;

/** Whether the reaction on the stage has no latents to decode the coarse layer from, since it was not made here. */
export const coarseIsMissing = ({ reaction }: Pick<AppState, 'reaction'>): boolean =>
  reaction !== null && reaction.latents === null;

/** The reaction shown side by side with the one on the stage, if any. */
export const besideStage = (state: AppState): Reaction | null =>
  state.compare === 'side' ? (otherTake(state)?.reaction ?? null) : null;

/** A reaction whose coarse layer can be decoded. */
type Layered = Reaction & { readonly latents: Float32Array };

/**
 * Decodes the coarse layer of the reaction on the stage, and of the one beside it, while its overlay is on: once for
 * each reaction; the request is aborted when another reaction takes its place.
 * @param model resolves with the model that makes the reactions
 * @returns a function that stops it
 */
export function createCoarseLayer(store: Store, model: () => Promise<Generator>): () => void {
  /** By latents. */
  const decodedMotions = new RecentCache<Float32Array, SolvedMotion>(MOST_DECODED);
  let running: AbortController | null = null;

  const decoded = (reaction: Reaction | null): SolvedMotion | null =>
    (reaction?.latents && decodedMotions.get(reaction.latents)) ?? null;

  /** Puts what has been decoded so far into the state. */
  const show = (decoding: boolean): void => {
    const state = store.getState();
    const { reaction, coarse } = state;
    const before = decoding && reaction?.latents ? coarse.motion : null;
    const now = { motion: decoded(reaction) ?? before, other: decoded(besideStage(state)), decoding };
    if (now.motion !== coarse.motion || now.other !== coarse.other || decoding !== coarse.decoding)
      apply(store, coarseChanged(now));
  };

  const decode = async (missing: readonly Layered[]): Promise<void> => {
    const controller = new AbortController();
    running = controller;
    const { signal } = controller;
    show(true);
    try {
      const generator = await model();
      for (const { inputs, latents } of missing) {
        const { leader, fitted, music, role, height, holdHands } = requestFor(inputs, generator.manifest);
        const request = { leader, fitted, music, role, height, holdHands, latents };
        const { motion, locked } = await generator.coarse(request, { signal });
        cacheLocked(motion, locked);
        decodedMotions.set(latents, motion);
        if (signal.aborted) return;
        show(latents !== missing.at(-1)?.latents);
      }
    } catch (error) {
      if (signal.aborted) return;
      show(false);
      if (isAbort(error)) return;
      apply(store, problemShown(coarseProblem(error)));
      // The visitor may switch it on again; it is not tried again by itself.
      if (store.getState().overlays.ghost) apply(store, overlayToggled('ghost'));
    }
  };

  const stop = watchAll(
    store,
    (state) => [state.reaction?.latents, besideStage(state)?.latents, state.overlays.ghost],
    (state) => {
      running?.abort();
      running = null;
      const missing = [state.reaction, besideStage(state)].filter(
        (reaction): reaction is Layered => Boolean(reaction?.latents) && !decoded(reaction),
      );
      if (state.overlays.ghost && missing.length > 0) void decode(missing);
      else show(false);
    },
  );
  return () => {
    stop();
    running?.abort();
  };
}
