/** Inputs and outputs of the three graphs of a model, row-major arrays. T counts motion frames. */

/** Inputs of the condition graph, T a multiple of the latent stride. */
export interface ConditionInput {
  /** T x 22 x 3, metres at the model's reference height. */
  readonly leader: Float32Array;
  /** T x features. */
  readonly music: Float32Array;
  /** T, 1 where there is a song. */
  readonly musicValid: Float32Array;
  /** Role to generate: 0 the reactor, 1 the leader. */
  readonly role: number;
}

export interface ConditionOutput {
  /** latents x memory width, what the step graph attends to. */
  readonly memory: Float32Array;
  /** latents: how far the leader is from those of training, about 1 for one of them. */
  readonly unfamiliarity: Float32Array;
}

export type ConditionRunner = (input: ConditionInput) => Promise<ConditionOutput>;

/** Latents, blocks x block x layers x channels, where a graph left them: in memory or on the graphics card. */
export interface HeldLatents {
  /** A copy in memory. */
  read(): Promise<Float32Array>;
  /** Frees them; once they are free, no graph takes them. */
  free(): void;
}

/** Inputs of the step graph. */
export interface StepInput {
  readonly blocks: number;
  /** blocks x block x layers x channels, noisy latents. */
  readonly x: Float32Array | HeldLatents;
  /** blocks x block x memory width, of the condition graph. */
  readonly memory: Float32Array;
  /** blocks x block, 1 inside the clip and 0 in padding. */
  readonly valid: Float32Array;
  /** 1 with leader and song as the memory has them, 0 without both. */
  readonly keep: number;
  /** Timestep divided by the number of train steps. */
  readonly time: number;
  /** The next latents are a x + b x0, with x0 predicted. */
  readonly a: number;
  readonly b: number;
}

/** One sampling step over blocks: noisy latents of the next step, clean ones after the last. */
export type StepRunner = (input: StepInput) => Promise<HeldLatents>;

/** Inputs of the decode graph. */
export interface DecodeInput {
  /** latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** As in `ConditionInput`. */
  readonly leader: Float32Array;
  /** streams x layers: a factor of each residual layer, 0 to leave it out. */
  readonly gains: Float32Array;
  /** As in `ConditionInput`: whose body dances. */
  readonly role: number;
}

/** Gives T x 22 x 3 metres. A part of a clip is exact but for the manifest's receptive field at its ends. */
export type DecodeRunner = (input: DecodeInput) => Promise<Float32Array>;
