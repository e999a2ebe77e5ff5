import type { MotionClip } from '../motion/clip';
import { bodyHeight } from '../motion/scale';
import type { ConditionInput } from './chunks';
import { ModelError } from './error';
import type { Manifest } from './manifest';

/** What a person asks for. */
export interface GenerateRequest {
  /** The dancer that is there, at the size of their file. */
  readonly leader: MotionClip;
  /** frames x features of the song from frame 0 of the clip; null for silence. */
  readonly music: { readonly features: Float32Array; readonly frames: number } | null;
  /** streams x layers, s of the paper's Eq. 9. */
  readonly guidance: Float32Array;
  readonly steps: number;
  /** Its lowest 32 bits count. */
  readonly seed: number;
  /** Whose part is wanted; the reactor's when not given. */
  readonly role?: 'reactor' | 'leader' | undefined;
}

/** A request as the graphs take it. */
export interface ModelInput {
  readonly condition: ConditionInput;
  /** The clip's positions were multiplied by this to reach the model's reference height. */
  readonly scale: number;
}

function refuse(message: string, hint: string): never {
  throw new ModelError('bad-request', message, hint);
}

/** @throws {ModelError} `bad-request`, a sentence about the first thing that the model cannot take */
export function checkRequest(
  { leader, music, guidance, steps, seed }: GenerateRequest,
  manifest: Manifest,
): void {
  const { skeleton, fps, diffusion, latent, audio } = manifest;
  if (leader.fps !== fps) {
    refuse(
      `The leader has ${leader.fps} frames per second; the model takes ${fps}.`,
      'Resample the clip first.',
    );
  }
  if (leader.frames < 1 || leader.positions.length !== leader.frames * skeleton.joints.length * 3) {
    refuse('The leader clip is empty or incomplete.', 'Choose another leader file.');
  }
  if (!leader.positions.every(Number.isFinite)) {
    refuse('The leader clip holds a position that is not a number.', 'Choose another leader file.');
  }
  if (music !== null && music.features.length !== music.frames * audio.features) {
    refuse(`The song does not have ${audio.features} features in every frame.`, 'Load the song again.');
  }
  if (music !== null && !music.features.every(Number.isFinite)) {
    refuse('The song holds a feature that is not a number.', 'Choose another song.');
  }
  if (!Number.isInteger(steps) || steps < diffusion.steps.min || steps > diffusion.steps.max) {
    refuse(
      `${steps} is not a number of steps between ${diffusion.steps.min} and ${diffusion.steps.max}.`,
      'Choose another number of steps.',
    );
  }
  if (guidance.length !== latent.streams.length * latent.layers.length || !guidance.every(Number.isFinite)) {
    refuse(
      `The guidance is not ${latent.streams.length} x ${latent.layers.length} numbers.`,
      'Set the guidance sliders again.',
    );
  }
  if (!Number.isInteger(seed)) refuse(`The seed ${seed} is not a whole number.`, 'Choose a whole number.');
}

/** Scale the leader to the reference height, and bring leader and music to a common, whole number of latent frames. */
export function prepareInput({ leader, music, role }: GenerateRequest, manifest: Manifest): ModelInput {
  const { latent, skeleton, audio } = manifest;
  const frame = skeleton.joints.length * 3;
  const frames = Math.ceil(leader.frames / latent.stride) * latent.stride;
  const scale = skeleton.reference_height / bodyHeight(leader);
  if (!Number.isFinite(scale)) refuse('The leader has no body height.', 'Choose another leader file.');
  const positions = new Float32Array(frames * frame);
  leader.positions.forEach((value, i) => (positions[i] = value * scale));
  for (let at = leader.frames * frame; at < positions.length; at += frame) {
    positions.copyWithin(at, (leader.frames - 1) * frame, leader.frames * frame);
  }
  const features = new Float32Array(frames * audio.features);
  const heard = music === null ? 0 : Math.min(music.frames, frames);
  if (music !== null) features.set(music.features.subarray(0, heard * audio.features));
  const musicValid = new Float32Array(frames).fill(1, 0, heard);
  return {
    condition: { leader: positions, music: features, musicValid, role: role === 'leader' ? 1 : 0 },
    scale,
  };
}
