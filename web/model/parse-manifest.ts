import * as v from 'valibot';
import { AppError } from '../common/error';
import { FLOOR } from '../motion/retarget/axes-and-units';
import { PARENTS, SMPL22 } from '../motion/skeleton/skeleton';
import { shapeProblem } from './graph-shapes';
import { type Manifest, schema } from './manifest';

/** Most values of a block, 64 MB: a hundred times as many as a block of the shipped model has. */
const MAX_BLOCK = 2 ** 24;
/** Most positions of a fader. */
const MAX_FADER_STEPS = 10_000;

/** Each has a fader, and weights in the golden sampling. */
const LAYERS = ['coarse', 'fine'];

const REEXPORT = 'Export the model again with this version of the project, or use the model it ships with.';

function invalid(message: string): AppError {
  return new AppError('manifest-invalid', message, REEXPORT);
}

/** Says which field is wrong and how, in one sentence. */
function describe(issue: v.BaseIssue<unknown>): string {
  const path = v.getDotPath(issue);
  if (path === null) return "The model's manifest is not a JSON object.";
  if (issue.received === 'undefined') return `The model's manifest has no field "${path}".`;
  return `The model's manifest has a wrong field "${path}": ${issue.message}.`;
}

/** Statements that tie fields to each other and to what this page can draw. */
function check(manifest: Manifest): void {
  checkSkeleton(manifest.skeleton);
  checkLatents(manifest);
  checkDiffusion(manifest.diffusion);
  checkGuidance(manifest.guidance);
}

function same(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a.length === b.length && a.every((value, i) => value === b[i]);
}

function checkSkeleton({ joints, parents, floor }: Manifest['skeleton']): void {
  if (!same(joints, SMPL22) || !same(parents, PARENTS))
    throw new AppError(
      'model-unsupported',
      "The model's skeleton is not the 22-joint SMPL body that this page draws.",
      REEXPORT,
    );
  if (floor.toe_rest !== FLOOR.toe_rest || floor.percentile !== FLOOR.percentile)
    throw new AppError(
      'model-unsupported',
      'The model was trained on dancers whose floor was found in another way than this page finds it.',
      REEXPORT,
    );
}

function checkLatents(manifest: Manifest): void {
  const { latent, audio, fps } = manifest;
  if (!same(latent.layers, LAYERS))
    throw new AppError(
      'model-unsupported',
      `The model has the residual layers ${latent.layers.join(', ')}; ` +
        `this page steers models of two, ${LAYERS.join(' and ')}.`,
      'Use a model that was trained with two residual layers, as the one that the page ships with.',
    );
  const shapes = shapeProblem(manifest);
  if (shapes !== null) throw invalid(`The model's manifest ${shapes}.`);
  if (audio.sample_rate !== fps * audio.hop)
    throw invalid(
      `The model's manifest has ${audio.sample_rate / audio.hop} feature frames a second for ${fps} motion frames.`,
    );
  if (latent.block * Math.max(latent.stride, latent.layers.length * latent.channels) > MAX_BLOCK)
    throw invalid("The model's manifest has blocks that are too large to sample on this page.");
  if (latent.channels % latent.streams.length !== 0)
    throw invalid(
      `The model's manifest shares ${latent.channels} channels among ${latent.streams.length} streams.`,
    );
}

function checkDiffusion({
  alphas_cumprod: alphas,
  train_steps,
  last_time,
  steps,
}: Manifest['diffusion']): void {
  if (alphas.length !== train_steps)
    throw invalid(
      `The model's manifest lists ${alphas.length} values in "diffusion.alphas_cumprod" ` +
        `for ${train_steps} train steps.`,
    );
  if (!alphas.every((alpha, t) => alpha > 0 && alpha < (alphas[t - 1] ?? 1)))
    throw invalid(
      'The model\'s manifest has a "diffusion.alphas_cumprod" that does not fall from step to step.',
    );
  if (Math.round(last_time * train_steps) < 1)
    throw invalid('The model\'s manifest has a "diffusion.last_time" before the first train step.');
  if (steps > train_steps)
    throw invalid(
      `The model's manifest has ${steps} steps in "diffusion.steps" for ${train_steps} train steps.`,
    );
}

function checkGuidance({ coarse, fine, music, variety }: Manifest['guidance']): void {
  for (const [name, { min, max, step, default: preset }] of Object.entries({
    coarse,
    fine,
    music,
    variety,
  })) {
    if (!(min < max && min <= preset && preset <= max))
      throw invalid(`The model's manifest has a "guidance.${name}" that is not in order: min, default, max.`);
    if (!(step <= max - min && max - min <= MAX_FADER_STEPS * step))
      throw invalid(`The model's manifest has a "guidance.${name}" whose step does not fit its range.`);
  }
}

/**
 * Check a parsed manifest.
 * @throws {AppError} `manifest-invalid` naming the first wrong field, `model-unsupported` for another format,
 * version, skeleton or number of layers
 */
export function parseManifest(json: unknown): Manifest {
  const head = v.safeParse(v.looseObject({ format: v.string(), version: v.number() }), json);
  const expected = { format: schema.entries.format.literal, version: schema.entries.version.literal };
  if (head.success && (head.output.format !== expected.format || head.output.version !== expected.version)) {
    throw new AppError(
      'model-unsupported',
      `The model has format "${head.output.format}" version ${head.output.version}; ` +
        `this page reads "${expected.format}" version ${expected.version}.`,
      REEXPORT,
    );
  }
  const result = v.safeParse(schema, json);
  if (!result.success) throw invalid(describe(result.issues[0]));
  check(result.output);
  return result.output;
}
