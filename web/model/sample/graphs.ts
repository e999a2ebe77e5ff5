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

/** Returns the memory that the step graph attends to: latents x memory width. */
export type ConditionRunner = (input: ConditionInput) => Promise<Float32Array>;

/** Inputs of the step graph; `width` is layers x channels. */
export interface StepInput {
  readonly blocks: number;
  /** blocks x block x width, noisy latents. */
  readonly x: Float32Array;
  /** blocks x block x memory width, of the condition graph. */
  readonly memory: Float32Array;
  /** blocks x block, 1 inside the clip and 0 in padding. */
  readonly valid: Float32Array;
  /** Timestep divided by the number of train steps. */
  readonly time: number;
  /** streams x layers, s of the paper's Eq. 9. */
  readonly guidance: Float32Array;
  /** Weight of the guidance by music, which is added to Eq. 9. */
  readonly musicGuidance: number;
  /** a and b of x_next = a x + b x0. */
  readonly coefficients: readonly [number, number];
}

/** Outputs of the step graph, both blocks x block x width. */
interface StepOutput {
  readonly x: Float32Array;
  readonly x0: Float32Array;
}

export type StepRunner = (input: StepInput) => Promise<StepOutput>;

/** Inputs of the decode graph. */
export interface DecodeInput {
  /** latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** As in `ConditionInput`. */
  readonly leader: Float32Array;
  /** One multiplier per residual layer: 1 to decode it, 0 to leave it out. */
  readonly layers: Float32Array;
}

/** Returns T x 22 x 3 metres. Takes a clip in one piece: bones have their mean length over all of it. */
export type DecodeRunner = (input: DecodeInput) => Promise<Float32Array>;
