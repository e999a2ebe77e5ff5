import * as v from 'valibot';
import { FPS } from '../motion/skeleton/clip';
import { SMPL22 } from '../motion/skeleton/skeleton';

/** Far above what any model of this method has: sizes beyond it only fill the memory. */
const MAX_COUNT = 1e6;
const count = v.pipe(v.number(), v.integer(), v.minValue(1), v.maxValue(MAX_COUNT));
const natural = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(MAX_COUNT));
const joint = v.pipe(natural, v.maxValue(SMPL22.length - 1));
/** A number of some quantity that a person could have meant. */
const finite = v.pipe(v.number(), v.minValue(-1000), v.maxValue(1000));
/** Metres of a body's height. */
const height = v.pipe(v.number(), v.minValue(0.5), v.maxValue(3));

/** A file beside the manifest or below it. */
const path = v.pipe(
  v.string(),
  v.regex(/^[\w-][\w.-]*(\/[\w-][\w.-]*)*$/, 'Expected the path of a file beside the manifest'),
);

const file = v.object({
  path,
  bytes: v.pipe(v.number(), v.integer(), v.minValue(1), v.maxValue(2 ** 32)),
  sha256: v.pipe(v.string(), v.regex(/^[0-9a-f]{64}$/, 'Expected 64 hexadecimal digits')),
});

const graph = v.object({
  inputs: v.record(v.string(), v.array(v.union([v.string(), v.number()]))),
  outputs: v.record(v.string(), v.array(v.union([v.string(), v.number()]))),
  files: v.object({ wasm: file, webgpu: file }),
});

const positive = v.pipe(v.number(), v.minValue(0), v.maxValue(1e5));

/** Metres of a part of a body, metres a second of a foot, and frames around a moment. */
const bodyPart = v.pipe(v.number(), v.minValue(0), v.maxValue(1));
/** Rest offsets of a body, the root first. */
const body = v.pipe(
  v.array(v.pipe(v.array(v.pipe(v.number(), v.minValue(-1), v.maxValue(1))), v.length(3))),
  v.length(SMPL22.length),
  v.check(
    (offsets) => offsets.slice(1).every((offset) => Math.hypot(...offset) > 0),
    'Expected bones of some length',
  ),
);
const speed = v.pipe(v.number(), v.minValue(0), v.maxValue(10));
const around = v.pipe(v.number(), v.gtValue(0), v.maxValue(300));

/** Least and greatest weight, the distance between two of them, and the default. */
const range = v.object({ min: finite, max: finite, step: v.pipe(positive, v.gtValue(0)), default: finite });

/** Constants of the measures on the page, as Python has them; see quality/rules.ts. */
const quality = v.object({
  contact: v.object({
    percentile: v.pipe(positive, v.maxValue(100)),
    height: bodyPart,
    vertical_speed: speed,
    slide_speed: speed,
  }),
  penetration: v.object({
    capsules: v.array(
      v.object({ from: v.picklist(SMPL22), to: v.picklist(SMPL22), radius: bodyPart, beyond: bodyPart }),
    ),
    reference_height: height,
    deep: bodyPart,
  }),
  beats: v.object({ smoothing: around, tolerance: around }),
  seams: v.object({ radius: around, clear: around }),
  glide: v.object({
    ratio: v.pipe(positive, v.minValue(1), v.maxValue(100)),
    reach: v.pipe(positive, v.maxValue(10)),
    free_speed: speed,
  }),
});

const names = v.pipe(
  v.array(v.pipe(v.string(), v.regex(/^[a-z][a-z0-9_]{0,31}$/, 'Expected a short word'))),
  v.minLength(1),
  v.maxLength(32),
  v.check((all) => new Set(all).size === all.length, 'Expected different words'),
);

export const schema = v.object({
  format: v.literal('reactdance-model'),
  version: v.literal(10),
  id: v.pipe(v.string(), v.minLength(1)),
  name: v.string(),
  created: v.string(),
  /** Of the weights, and of the motion that they were trained on. */
  licence: v.object({ weights: v.string(), data: v.string() }),
  attribution: v.string(),
  notes: v.array(v.string()),
  skeleton: v.object({
    joints: v.array(v.string()),
    parents: v.array(v.number()),
    upper: v.array(joint),
    lower: v.array(joint),
    feet: v.array(joint),
    /** Metres; the body height (motion/skeleton/scale.ts) that every leader is scaled to. */
    reference_height: height,
    /** Rest offsets from the parent joint in a T-pose, metres at that height, of the dancer whom each role generates. */
    bodies: v.object({ reactor: body, leader: body }),
    /** The same of the dancers of the training, in whose bodies a loaded dancer is given to the model. */
    training_bodies: v.object({ reactor: body, leader: body }),
    /** Metres; body height of the reactors of the training beside leaders of that height. */
    reactor_height: height,
    /** See FLOOR in motion/retarget/axes-and-units.ts. */
    floor: v.object({ toe_rest: v.number(), percentile: v.number() }),
  }),
  /** That of every clip on the page. */
  fps: v.literal(FPS),
  /** Mean unfamiliarity from which a leader is unlike all that the model was trained on. */
  leader: v.object({ unfamiliar_from: v.pipe(positive, v.gtValue(0)) }),
  latent: v.object({
    /** Motion frames per latent frame. */
    stride: v.pipe(count, v.maxValue(64)),
    /** Latent frames per block. */
    block: v.pipe(count, v.maxValue(10_000)),
    /** Channels of one residual layer, all streams together. */
    channels: v.pipe(count, v.maxValue(65_536)),
    streams: names,
    layers: names,
    memory_width: v.pipe(count, v.maxValue(65_536)),
    /** Latent frames that a graph needs on each side of a piece of clip for an exact result inside it. */
    receptive_field: v.object({
      condition: v.pipe(natural, v.maxValue(10_000)),
      decode: v.pipe(natural, v.maxValue(10_000)),
    }),
  }),
  diffusion: v.object({
    train_steps: count,
    /** The signal's share of variance after each of the train_steps noising steps. */
    alphas_cumprod: v.pipe(v.array(v.pipe(v.number(), v.minValue(0), v.maxValue(1))), v.minLength(1)),
    prediction: v.literal('x0'),
    /** What predictions are clamped to (static thresholding); part of the step graph. */
    clamp: v.string(),
    sampler: v.literal('ddim'),
    /** Time of the last step, a share of train_steps. */
    last_time: v.pipe(v.number(), v.gtValue(0), v.maxValue(1)),
    /** How many steps a sampling has. */
    steps: count,
  }),
  guidance: v.object({
    /** How each weight acts, for a reader; blend.ts does it. */
    convention: v.record(v.string(), v.string()),
    coarse: range,
    fine: range,
    music: range,
    /** `seeds`: how many seeds, from 0, the mean is taken of that variety keeps a seed away from. */
    variety: v.object({ ...range.entries, seeds: v.pipe(count, v.maxValue(64)) }),
  }),
  noise: v.object({ algorithm: v.literal('philox4x32-10') }),
  /** What the decode graph does to decoded joints: strength of the foot-contact correction in m/s. */
  decode: v.object({ foot_contact: positive }),
  /** How the networks are built; the page reads none of it, a person can. */
  architecture: v.looseObject({}),
  /** The feature recipe; its other keys are checked by the audio side, which reads them. */
  audio: v.looseObject({ sample_rate: count, hop: count, features: count }),
  quality,
  graphs: v.object({ condition: graph, step: graph, decode: graph }),
  /** Inputs and results of one small sampling, as Python computed it. */
  golden: file,
});

/** Every number about a model that the page knows; written by export, checked by parse-manifest.ts. */
export type Manifest = v.InferOutput<typeof schema>;
export type GraphName = keyof Manifest['graphs'];
export type ManifestFile = v.InferOutput<typeof file>;

export const GRAPHS: readonly GraphName[] = ['condition', 'step', 'decode'];
