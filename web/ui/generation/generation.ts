import type {
  GenerateRequest,
  GenerateResult,
  Generator,
  Manifest,
  Preview as ModelPreview,
} from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { generationProblem, isAbort } from '../store/problems';
import { reactorMotion, cacheLocked } from '../store/reactor-motion';
import { guidanceMatrix, sameInputs, readyInputs } from '../store/selectors';
import { splice } from './splice';
import type { Inputs, Reaction } from '../store/reaction';
import { jobChanged, previewShown, reactionAdded } from '../store/actions/reaction';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/** Time without a change after which a new reaction is begun. */
const DEBOUNCE_MS = 60;

/**
 * Makes a new reaction whenever song, leader or settings change; a newer request aborts the older one. The reaction
 * on the stage stays there until the new one is ready, except for the frames around the playhead, which are replaced
 * by a preview as soon as the model has one.
 */
export class Generation {
  readonly #store: Store;
  readonly #model: () => Promise<Generator>;
  readonly #unsubscribe: () => void;
  /** The inputs requested last, whether answered, running, failed or cancelled: they are not requested again. */
  #requested: Inputs | null = null;
  #running: { readonly controller: AbortController; readonly inputs: Inputs } | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** @param model resolves with the model when it is loaded; rejects when it can't be, which is reported elsewhere */
  constructor(store: Store, model: () => Promise<Generator>) {
    this.#store = store;
    this.#model = model;
    this.#unsubscribe = store.subscribe(() => {
      this.#followInputs();
    });
  }

  /** Makes the reaction now, whether or not anything has changed. */
  readonly generate = (): void => {
    const inputs = readyInputs(this.#store.getState());
    if (inputs) void this.#run(inputs);
  };

  /** Aborts the running request; nothing begins again until something changes or `generate` is called. */
  readonly cancel = (): void => {
    this.#abort();
    apply(this.#store, jobChanged(null));
  };

  readonly dispose = (): void => {
    this.#unsubscribe();
    this.#abort();
  };

  #abort(): void {
    clearTimeout(this.#timer);
    this.#running?.controller.abort();
    this.#running = null;
  }

  #followInputs(): void {
    const state = this.#store.getState();
    const inputs = readyInputs(state);
    if (!inputs) return;
    if (state.reaction && sameInputs(inputs, state.reaction.inputs)) {
      this.#keepOnStage(inputs);
      return;
    }
    if (sameInputs(inputs, this.#requested)) return;
    this.#requested = inputs;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      void this.#run(inputs);
    }, DEBOUNCE_MS);
  }

  /** The reaction on the stage has these inputs: requests for others are aborted. */
  #keepOnStage(inputs: Inputs): void {
    this.#requested = inputs;
    clearTimeout(this.#timer);
    if (this.#running && !sameInputs(this.#running.inputs, inputs)) this.cancel();
  }

  async #run(inputs: Inputs): Promise<void> {
    this.#abort();
    this.#requested = inputs;
    const controller = new AbortController();
    this.#running = { controller, inputs };
    const { signal } = controller;
    try {
      apply(this.#store, jobChanged({ stage: 'waiting', done: 0, total: 1, fraction: 0, previewed: null }));
      const result = await this.#request(inputs, signal);
      if (signal.aborted) return;
      this.#running = null;
      apply(this.#store, reactionAdded(reactionOf(result, inputs)));
    } catch (error) {
      if (signal.aborted) return;
      this.#running = null;
      apply(this.#store, jobChanged(null));
      const failedToLoad = this.#store.getState().model.phase === 'failed';
      if (!isAbort(error) && !failedToLoad) apply(this.#store, problemShown(generationProblem(error)));
    }
  }

  /** Runs the model, showing progress and previews meanwhile. */
  async #request(inputs: Inputs, signal: AbortSignal): Promise<GenerateResult> {
    const generator = await this.#model();
    signal.throwIfAborted();
    const { playback, leader } = this.#store.getState();
    return generator.generate(requestFor(inputs, generator.manifest), {
      signal,
      onProgress: (progress) => {
        const previewed = this.#store.getState().job?.previewed ?? null;
        if (!signal.aborted) apply(this.#store, jobChanged({ ...progress, previewed }));
      },
      at: Math.floor(playback.time * (leader?.file.clip.fps ?? 0)),
      onPreview: (preview) => {
        if (!signal.aborted) showPreview(this.#store, preview);
      },
    });
  }
}

/** The request to the model for these inputs. */
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

/** The model's result as a reaction that can be shown. */
export function reactionOf({ motion, locked, latents, seconds }: GenerateResult, inputs: Inputs): Reaction {
  cacheLocked(motion, locked);
  const total = Object.values(seconds).reduce((sum, part) => sum + part, 0);
  return { motion, latents, inputs, label: null, seconds: total };
}

/** Puts the new frames into the reaction on the stage; without one, shows all that the model has so far. */
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
