import type {
  GenerateRequest,
  GenerateResult,
  Generator,
  Manifest,
  Preview as ModelPreview,
} from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { generationProblem, isAbort } from '../store/problems';
import { reactorMotion, rememberLocked } from '../store/reactor-motion';
import { guidanceMatrix, sameInputs, readyInputs } from '../store/selectors';
import { splice } from './splice';
import type { Inputs, Reaction } from '../store/state';
import { jobChanged, previewShown, reactionAdded } from '../store/actions/reaction';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

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
 * newer wish drops the older one. Whatever was on the stage stays there until the new reaction is ready, save for the
 * part under the playhead, which changes as soon as it can.
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
      apply(store, jobChanged({ stage: 'waiting', done: 0, total: 1, fraction: 0, previewed: null }));
      const generator = await model();
      if (signal.aborted) return;
      const { playback, leader } = store.getState();
      const made = await generator.generate(requestFor(inputs, generator.manifest), {
        signal,
        onProgress: (progress) => {
          const previewed = store.getState().job?.previewed ?? null;
          if (!signal.aborted) apply(store, jobChanged({ ...progress, previewed }));
        },
        at: Math.floor(playback.time * (leader?.file.clip.fps ?? 0)),
        onPreview: (preview) => {
          if (!signal.aborted) showPreview(store, preview);
        },
      });
      if (signal.aborted) return;
      running = null;
      apply(store, reactionAdded(reactionOf(made, inputs)));
    } catch (error) {
      if (signal.aborted) return;
      running = null;
      apply(store, jobChanged(null));
      const failedToLoad = store.getState().model.phase === 'failed';
      if (!isAbort(error) && !failedToLoad) apply(store, problemShown(generationProblem(error)));
    }
  };

  const consider = (): void => {
    const state = store.getState();
    const wanted = readyInputs(state);
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
      const wanted = readyInputs(store.getState());
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

/** What the model is asked for. */
export function requestFor({ song, leader, shift, settings }: Inputs, manifest: Manifest): GenerateRequest {
  return {
    leader: leader.file.clip,
    music: song ? { features: song.data.features, frames: song.data.frames, start: shift } : null,
    guidance: guidanceMatrix(settings, manifest.latent),
    musicGuidance: settings.music,
    steps: settings.steps,
    seed: settings.seed,
    role: settings.role,
  };
}

/** What the model made, as a reaction that can be shown. */
export function reactionOf({ motion, locked, latents, seconds }: GenerateResult, inputs: Inputs): Reaction {
  rememberLocked(motion, locked);
  const took = Object.values(seconds).reduce((sum, part) => sum + part, 0);
  return { motion, latents, inputs, label: null, seconds: took };
}

/** Puts the new part into what is on the stage; where nothing is, the whole of what the model has so far. */
function showPreview(store: Store, { motion, locked, fresh }: ModelPreview): void {
  const { reaction } = store.getState();
  const into = (shown: SolvedMotion | null, made: SolvedMotion): SolvedMotion =>
    shown?.frames === made.frames ? splice(shown, made, fresh) : made;
  const preview = {
    motion: into(reaction?.motion ?? null, motion),
    locked: into(reactorMotion({ reaction, footLock: true }), locked),
  };
  apply(store, previewShown(preview, fresh));
}
