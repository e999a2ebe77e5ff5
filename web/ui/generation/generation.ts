import type {
  GenerateRequest,
  GenerateResult,
  Generator,
  Manifest,
  Preview as ModelPreview,
} from '../../model/client';
import { generationProblem, isAbort } from '../store/problems';
import { reactorMotion, cacheLocked } from '../store/reactor-motion';
import { differOnlyInWeights, guidanceMatrix, readyInputs, sameInputs } from '../store/selectors';
import { splice } from './splice';
import type { Inputs, Reaction } from '../store/reaction';
import { jobChanged, previewShown, reactionAdded } from '../store/actions/reaction';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/** Time without a change of song, leader, seed or steps after which a new reaction is begun. */
const DEBOUNCE_MS = 60;

/**
 * Makes a new reaction whenever song, leader or settings change. The reaction on the stage stays there until the new
 * one is ready, except for the frames around the playhead, which are replaced by a preview before.
 *
 * A new song, leader or seed has to be sampled, so the request aborts the older one. Weights only blend what is
 * sampled: a request under way goes on until its preview is shown, then the newest weights follow, so that the dance
 * changes while a fader moves.
 */
export class Generation {
  readonly #store: Store;
  readonly #model: () => Promise<Generator>;
  readonly #unsubscribe: () => void;
  /** The inputs requested last, whether answered, running, failed or cancelled: they are not requested again. */
  #requested: Inputs | null = null;
  #running: { readonly controller: AbortController; readonly inputs: Inputs } | null = null;
  /** Weights that came while a request was under way. */
  #waiting: Inputs | null = null;
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
    this.#waiting = null;
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
    const before = this.#requested;
    this.#requested = inputs;
    clearTimeout(this.#timer);
    if (!before || !differOnlyInWeights(before, inputs)) {
      this.#timer = setTimeout(() => {
        void this.#run(inputs);
      }, DEBOUNCE_MS);
    } else if (this.#running) this.#waiting = inputs;
    else void this.#run(inputs);
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
      const waiting = this.#waiting;
      apply(this.#store, reactionAdded(reactionOf(result, inputs)));
      if (waiting) void this.#run(waiting);
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
        if (signal.aborted) return;
        showPreview(this.#store, preview);
        if (this.#waiting) void this.#run(this.#waiting);
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
    variety: settings.variety,
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

/** Puts the new frames into the reaction on the stage, if it is one of this dance. */
function showPreview(store: Store, { motion, locked, fresh }: ModelPreview): void {
  const { reaction, preview: before, leader } = store.getState();
  const shown =
    before ?? (reaction && { motion: reaction.motion, locked: reactorMotion({ reaction, footLock: true }) });
  if (!shown?.locked || shown.motion.frames !== leader?.file.clip.frames) return;
  const preview = {
    motion: splice(shown.motion, motion, fresh),
    locked: splice(shown.locked, locked, fresh),
  };
  apply(store, previewShown(preview, fresh));
}
