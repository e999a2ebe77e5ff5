import { stepCounts } from '../../motion/beats/step-timing';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { inBody } from '../../motion/skeleton/kinematics';
import { bodyHeight } from '../../motion/skeleton/scale';
import type { ConditionInput } from './graphs';
import { AppError } from '../../common/error';
import type { Role } from '../../common/role';
import type { Manifest } from '../manifest';
import type { Weights } from './blend';

/** What is danced to. */
export interface Source {
  /** The dancer to react to, at the size of their file. */
  readonly leader: MotionClip;
  /** The same dancer on a skeleton. */
  readonly fitted: SolvedMotion;
  /**
   * frames x features of the song; null for silence. `beats`: seconds of the song, ascending, to which the dancer steps;
   * none when not given. The song starts at frame `start` of the clip, 0 when not given; below 0 its beginning is not
   * heard.
   */
  readonly music: {
    readonly features: Float32Array;
    readonly frames: number;
    readonly beats?: readonly number[] | undefined;
    readonly start?: number | undefined;
  } | null;
  /** Role to generate; the reactor when not given. */
  readonly role?: Role | undefined;
}

/** Whether two sources are the same arrays. */
export function sameSource(a: Source, b: Source): boolean {
  return (
    a.leader === b.leader &&
    a.fitted === b.fitted &&
    a.role === b.role &&
    a.music?.features === b.music?.features &&
    a.music?.beats === b.music?.beats &&
    a.music?.start === b.music?.start
  );
}

/** Settings of what is done after decoding: another one needs no pass of the network. */
export interface SolveSettings {
  /** From the floor to the crown of the head, metres; in proportion to the loaded dancer when not given. */
  readonly height?: number | undefined;
  /** Whether hands hold the loaded dancer's where they are near; they do when not given. */
  readonly holdHands?: boolean | undefined;
}

/** Least and greatest height that can be asked for, metres. */
export const HEIGHTS = { min: 0.5, max: 2.5 };

/** Least and greatest seed. */
export const SEEDS = { min: 0, max: 2 ** 32 - 1 };

/** How it is danced. */
export interface DanceSettings extends Weights, SolveSettings {
  /** Its lowest 32 bits count. */
  readonly seed: number;
}

/** What to generate, and from what. */
export interface GenerateRequest extends Source, DanceSettings {}

/** Whether two requests ask for the same joints, with whatever settings of solving. */
export function sameDecoded(a: GenerateRequest, b: GenerateRequest): boolean {
  return (
    sameSource(a, b) &&
    a.seed === b.seed &&
    a.musicGuidance === b.musicGuidance &&
    a.variety === b.variety &&
    a.guidance.length === b.guidance.length &&
    a.guidance.every((weight, i) => weight === b.guidance[i])
  );
}

/** Seeds of which those are wanted whose dances differ most. */
export interface SeedsRequest {
  /** What the dances have in common; its own seed is not used. */
  readonly request: GenerateRequest;
  readonly seeds: readonly number[];
  /** How many are wanted. */
  readonly count: number;
  /** Once there are that many dances, no other is begun that would take longer than this altogether, seconds. */
  readonly seconds: number;
}

/** A reaction that was generated before from this source, of which the coarse layer is to be decoded alone. */
export interface CoarseRequest extends SolveSettings, Source {
  /** latents x layers x channels, normalised, as this model generated them. */
  readonly latents: Float32Array;
}

/** A request as the graphs take it. */
export interface ModelInput {
  readonly condition: ConditionInput;
  /** The leader's joints at the model's reference height, latent frames x stride x 22 x 3: what latents are decoded beside. */
  readonly leader: Float32Array;
  /** The clip's positions were multiplied by this to reach the model's reference height. */
  readonly scale: number;
  /** Steps to the song's beats by each frame, `stepCounts`. */
  readonly steps: Float64Array;
}

function refuse(message: string, hint: string): never {
  throw new AppError('bad-request', message, hint);
}

/** @throws {AppError} `bad-request`, a sentence about the first thing that the model cannot take */
export function checkSource({ leader, fitted, music }: Source, { skeleton, fps, audio }: Manifest): void {
  if (leader.fps !== fps) {
    refuse(
      `The leader has ${leader.fps} frames per second; the model takes ${fps}.`,
      'Resample the clip first.',
    );
  }
  const length = leader.frames * skeleton.joints.length * 3;
  if (leader.frames < 1 || [leader, fitted].some(({ positions }) => positions.length !== length)) {
    refuse('The leader clip is empty or incomplete.', 'Choose another leader file.');
  }
  if (!leader.positions.every(Number.isFinite)) {
    refuse('The leader clip holds a position that is not a number.', 'Choose another leader file.');
  }
  if (music === null) return;
  if (music.features.length !== music.frames * audio.features) {
    refuse(`The song does not have ${audio.features} features in every frame.`, 'Load the song again.');
  }
  if (!music.features.every(Number.isFinite)) {
    refuse('The song holds a feature that is not a number.', 'Choose another song.');
  }
  if (music.start !== undefined && !Number.isInteger(music.start)) {
    refuse(`The song starts at frame ${music.start}.`, 'Shift the song by whole frames.');
  }
}

/** @throws {AppError} as `checkSource` */
export function checkSettings(
  { guidance, musicGuidance, variety, seed, height }: DanceSettings,
  { latent }: Manifest,
): void {
  if (guidance.length !== latent.streams.length * latent.layers.length || !guidance.every(Number.isFinite)) {
    refuse(
      `The guidance is not ${latent.streams.length} x ${latent.layers.length} numbers.`,
      'Set the guidance sliders again.',
    );
  }
  if (!Number.isFinite(musicGuidance)) {
    refuse('The guidance of the music is not a number.', 'Set the music slider again.');
  }
  if (!Number.isFinite(variety)) refuse('The variety is not a number.', 'Set the variety slider again.');
  if (!Number.isInteger(seed)) refuse(`The seed ${seed} is not a whole number.`, 'Choose a whole number.');
  if (height !== undefined && !(height >= HEIGHTS.min && height <= HEIGHTS.max)) {
    refuse(
      `A height of ${height} m is not between ${HEIGHTS.min} and ${HEIGHTS.max} m.`,
      'Set another height, or the one in proportion.',
    );
  }
}

/** @throws {AppError} `bad-request` when the latents are not those of a dance as long as the leader's */
export function checkCoarse({ leader, latents }: CoarseRequest, { latent }: Manifest): void {
  const wanted = Math.ceil(leader.frames / latent.stride) * latent.layers.length * latent.channels;
  if (latents.length === wanted) return;
  refuse('The reaction was not made for this leader by this model.', 'Generate the reaction again.');
}

/**
 * Scales the leader to the reference height, and brings leader and music to a common, whole number of latent frames. The
 * condition gets the leader in the body of the training's leaders: rigs put shoulders and hips in other places, and the
 * network has seen few bodies.
 */
export function prepareInput({ leader, fitted, music, role }: Source, manifest: Manifest): ModelInput {
  const { latent, skeleton, audio } = manifest;
  const frame = skeleton.joints.length * 3;
  const frames = Math.ceil(leader.frames / latent.stride) * latent.stride;
  const scale = skeleton.reference_height / bodyHeight(leader);
  if (!Number.isFinite(scale)) refuse('The leader has no body height.', 'Choose another leader file.');
  const given = role === 'leader' ? 'reactor' : 'leader';
  const known = Float32Array.from(skeleton.training_bodies[given].flat());
  const whole = (values: Float32Array): Float32Array => {
    const positions = new Float32Array(frames * frame);
    positions.set(values);
    for (let at = values.length; at < positions.length; at += frame)
      positions.copyWithin(at, values.length - frame, values.length);
    return positions;
  };
  const features = new Float32Array(frames * audio.features);
  const musicValid = new Float32Array(frames);
  if (music !== null) {
    const { start = 0 } = music;
    const from = Math.min(frames, Math.max(0, start));
    const to = Math.max(from, Math.min(frames, start + music.frames));
    const heard = music.features.subarray((from - start) * audio.features, (to - start) * audio.features);
    features.set(heard, from * audio.features);
    musicValid.fill(1, from, to);
  }
  const beats = music?.beats?.map((seconds) => (music.start ?? 0) + seconds * leader.fps) ?? [];
  return {
    condition: {
      leader: whole(inBody(leader, fitted, known, scale)),
      music: features,
      musicValid,
      role: role === 'leader' ? 1 : 0,
    },
    leader: whole(leader.positions.map((value) => value * scale)),
    scale,
    steps: stepCounts(beats, frames, leader.fps),
  };
}
