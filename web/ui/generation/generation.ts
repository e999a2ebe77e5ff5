import {
  type GenerateRequest,
  type GenerateResult,
  type Generator,
  type Manifest,
  type Playhead,
  type Preview as ModelPreview,
  secondsNow,
} from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { generationProblem, isAbort } from '../store/problems';
import { reactorMotion, cacheLocked } from '../store/reactor-motion';
import { differOnlyInWeights, guidanceMatrix, readyInputs, sameInputs } from '../store/selectors';
import { currentInputs } from '../store/take';
import { modelIdentity, type Inputs, type Reaction } from '../store/reaction';
import { firstVisitEnded } from '../store/actions/files';
import { jobChanged, previewShown, reactionAdded } from '../store/actions/reaction';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';

/** A request that the model is working on. */
interface Running {
  readonly controller: AbortController;
  readonly inputs: Inputs;
  /** Asked for by the visitor, even if there is such a reaction already. */
  readonly asked: boolean;
  /** Whether its part around the playhead has been shown, or the model has gone past it. */
  previewed: boolean;
}

/**
 * Makes a new reaction whenever song, leader or settings change. The reaction on the stage stays there until the new
 * one is ready, except for the frames around the playhead, which are replaced by a preview before.
 *
 * A change aborts the request before it. Where both differ only in weights of guidance it is not aborted before its
 * preview is shown: while a fader moves, each preview is of the newest weights and the next one follows, so that the
 * dance goes with the hand, and the whole dance is made when the hand rests.
 */
export class Generation {
  readonly #store: Store;
  readonly #model: () => Promise<Generator>;
  readonly #unsubscribe: () => void;
  /** The inputs requested last, whether answered, running, failed or cancelled: they are not requested again. */
  #requested: Inputs | null = null;
  #running: Running | null = null;
  /** The newest weights, which came before the preview of older ones. */
  #waiting: Inputs | null = null;
  /** Whether the last request failed because the model could not be loaded. */
  #unloaded = false;
  /** The inputs are looked at when the present task's changes have been made. */
  #queued = false;
  #disposed = false;

  /** @param model resolves with the model when it is loaded; rejects when it can't be, which is reported elsewhere */
  constructor(store: Store, model: () => Promise<Generator>) {
    this.#store = store;
    this.#model = model;
    this.#unsubscribe = store.subscribe(() => {
      if (this.#queued) return;
      this.#queued = true;
      // Changes that are made together are one request: of a leader and a ready-made reaction, of seed and take.
      queueMicrotask(() => {
        this.#queued = false;
        if (!this.#disposed) this.#followInputs();
      });
    });
  }

  /** Makes the reaction now, whether or not anything has changed. */
  readonly generate = (): void => {
    const inputs = readyInputs(this.#store.getState());
    if (inputs) void this.#run(inputs, true);
  };

  /** The model is loaded once more: what could not be made without it is requested again. */
  readonly resume = (): void => {
    if (!this.#unloaded) return;
    this.#requested = null;
    this.#followInputs();
  };

  /** Aborts the running request; nothing begins again until something changes or `generate` is called. */
  readonly cancel = (): void => {
    this.#abort();
    apply(this.#store, jobChanged(null));
  };

  readonly dispose = (): void => {
    this.#disposed = true;
    this.#unsubscribe();
    this.#abort();
  };

  #abort(): void {
    this.#unloaded = false;
    this.#waiting = null;
    this.#running?.controller.abort();
    this.#running = null;
  }

  #followInputs(): void {
    const state = this.#store.getState();
    const inputs = readyInputs(state);
    if (!inputs) {
      this.#endUnwanted(state);
      return;
    }
    if (state.reaction && sameInputs(inputs, state.reaction.inputs)) {
      this.#keepOnStage(inputs);
      return;
    }
    if (sameInputs(inputs, this.#requested)) return;
    this.#requested = inputs;
    const running = this.#running;
    if (running && !running.previewed && differOnlyInWeights(running.inputs, inputs)) this.#waiting = inputs;
    else void this.#run(inputs);
  }

  /**
   * While a file is read a request goes on, unless its leader is no longer on the page, or has the other role. If they
   * come back, as by undoing that all was cleared, it begins again.
   */
  #endUnwanted(state: AppState): void {
    const now = currentInputs(state);
    const last = this.#requested;
    if (!last || (now?.leader === last.leader && now.settings.role === last.settings.role)) return;
    this.#requested = null;
    if (this.#running) this.cancel();
  }

  /**
   * The reaction on the stage has these inputs: requests for others are aborted, and one for the same where the reaction
   * came ready-made a moment after its song.
   */
  #keepOnStage(inputs: Inputs): void {
    this.#requested = inputs;
    this.#waiting = null;
    const running = this.#running;
    if (running && !(running.asked && sameInputs(running.inputs, inputs))) this.cancel();
  }

  async #run(inputs: Inputs, asked = false): Promise<void> {
    this.#abort();
    this.#requested = inputs;
    const controller = new AbortController();
    const running: Running = { controller, inputs, asked, previewed: false };
    this.#running = running;
    const { signal } = controller;
    try {
      // Whoever asks for another dance to the same files wants to see it, not what the page is for.
      if (sameFiles(this.#store.getState().reaction, inputs)) apply(this.#store, firstVisitEnded());
      apply(this.#store, jobChanged({ stage: 'waiting', fraction: 0 }));
      const reaction = await this.#request(running, signal);
      if (signal.aborted) return;
      this.#running = null;
      const waiting = this.#waiting;
      apply(this.#store, reactionAdded(reaction));
      if (waiting) void this.#run(waiting);
    } catch (error) {
      if (signal.aborted) return;
      this.#running = null;
      apply(this.#store, jobChanged(null));
      this.#unloaded = this.#store.getState().model.phase === 'failed';
      if (!isAbort(error) && !this.#unloaded) apply(this.#store, problemShown(generationProblem(error)));
    }
  }

  /** Runs the model, showing progress and the preview meanwhile. */
  async #request(running: Running, signal: AbortSignal): Promise<Reaction> {
    const generator = await this.#model();
    signal.throwIfAborted();
    const result = await generator.generate(requestFor(running.inputs, generator.manifest), {
      signal,
      onProgress: (progress) => {
        if (!signal.aborted) apply(this.#store, jobChanged(progress));
      },
      playhead: playheadOf(this.#store.getState()),
      onPreview: (preview) => {
        if (signal.aborted) return;
        running.previewed = true;
        showPreview(this.#store, preview);
        if (this.#waiting) void this.#run(this.#waiting);
      },
    });
    return reactionOf(result, running.inputs, generator.manifest);
  }
}

function playheadOf({ playback, leader }: AppState): Playhead {
  const fps = leader?.file.clip.fps ?? 0;
  const rate = playback.playing ? playback.speed * fps : 0;
  return { frame: playback.time * fps, at: secondsNow(), rate };
}

/** The request to the model for these inputs. */
export function requestFor({ song, leader, shift, settings }: Inputs, manifest: Manifest): GenerateRequest {
  return {
    leader: leader.file.clip,
    fitted: leader.motion,
    music: song && {
      features: song.data.features,
      frames: song.data.frames,
      beats: song.data.rhythm.beats,
      start: shift,
    },
    guidance: guidanceMatrix(settings, manifest.latent),
    musicGuidance: settings.music,
    variety: settings.variety,
    seed: settings.seed,
    role: settings.role,
    height: settings.height ?? undefined,
    holdHands: settings.holdHands,
  };
}

/** The model's result as a reaction that can be shown. */
export function reactionOf(result: GenerateResult, inputs: Inputs, manifest: Manifest): Reaction {
  const { motion, locked, latents, unfamiliarity } = result;
  cacheLocked(motion, locked);
  const seconds = Object.values(result.seconds).reduce((sum, part) => sum + part, 0);
  const model = modelIdentity(manifest);
  return { motion, latents, model, unfamiliarity, inputs, label: null, seconds };
}

/**
 * Puts the new frames into the reaction on the stage, if that is the same body. They are not crossfaded with the old
 * ones around them: those are out of view, and the whole replaces them before the playhead gets there.
 */
function showPreview(store: Store, { motion, locked, from }: ModelPreview): void {
  const { reaction, preview } = store.getState();
  if (!reaction || !sameBody(reaction.motion, motion)) return;
  const shown = preview ?? { motion: reaction.motion, locked: reactorMotion({ reaction, footLock: true })! };
  apply(
    store,
    previewShown({
      motion: withFrames(shown.motion, motion, from),
      locked: withFrames(shown.locked, locked, from),
    }),
  );
}

/** A motion with some frames replaced by those of a part of the same body, from the frame `from` on. */
function withFrames(whole: SolvedMotion, part: SolvedMotion, from: number): SolvedMotion {
  const replaced = (values: Float32Array, newer: Float32Array): Float32Array => {
    const copy = values.slice();
    copy.set(newer, (values.length / whole.frames) * from);
    return copy;
  };
  return {
    ...whole,
    root: replaced(whole.root, part.root),
    rotations: replaced(whole.rotations, part.rotations),
    positions: replaced(whole.positions, part.positions),
  };
}

/** Whether two motions have the same skeleton. */
function sameBody(a: SolvedMotion, b: SolvedMotion): boolean {
  return a.offsets.every((value, i) => value === b.offsets[i]);
}

function sameFiles(reaction: Reaction | null, { leader, song }: Inputs): boolean {
  return reaction?.inputs.leader === leader && reaction.inputs.song === song;
}
