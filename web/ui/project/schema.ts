/** The shape and the limits of the records in the database and in project files. */
import * as v from 'valibot';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { ALL_UNITS, UP_AXES } from '../../motion/retarget/axes-and-units';
import { checkPlausible } from '../../motion/skeleton/plausible';
import { J, JOINT_COUNT, SMPL22 } from '../../motion/skeleton/skeleton';
import { VIEWS } from '../../common/framing';
import { MAX_TAKE_NAME_LENGTH } from '../store/actions/takes';
import { MIN_LOOP } from '../store/actions/timeline';
import type { StoredInputs } from './stored-project';

/** Most songs, and most leaders, that are read again: each takes a worker of its own for a while. */
export const MAX_FILES = 100;
const MAX_NAME_LENGTH = 1000;
/** Most files that a leader is read from, with those that belong to it: any that were dropped with it may. */
const MAX_LEADER_FILES = 1000;
/** Most graphs of a model. */
const MAX_GRAPHS = 10;
/** Largest rest offset of a joint from its parent, metres. */
const MAX_BONE = 2;
/** Largest distance between the root and the pelvis that follows from it, metres. */
const MAX_ROOT_ERROR = 0.01;
/** How far from 1 the length of a rotation may be. */
const MAX_ROTATION_ERROR = 0.01;
/** Latest moment that a date can hold, milliseconds since 1970. */
const MAX_DATE = 8.64e15;

/** Longest time that a song can have, seconds. */
const MAX_SECONDS = 3600;

/** How far from the couple a camera may look or stand, and how near it may be, metres. */
const MAX_PAN = 100;
const MIN_DISTANCE = 0.1;
/** Most that a camera may have turned, radians. */
const MAX_HEADING = 1e4;

const text = v.pipe(v.string(), v.maxLength(MAX_NAME_LENGTH));
const id = v.pipe(text, v.minLength(1));
const label = v.nullable(text);
const amount = v.pipe(v.number(), v.minValue(0), v.maxValue(1e6));
const count = v.pipe(amount, v.integer());
const inputs = v.custom<StoredInputs>(
  (value) => value !== null && typeof value === 'object' && !Array.isArray(value),
);

export const song = v.pipe(
  v.object({
    id,
    name: text,
    label,
    type: text,
    bytes: v.union([v.instance(ArrayBuffer), v.instance(Uint8Array<ArrayBuffer>)]),
  }),
  v.check(({ bytes }) => bytes.byteLength > 0),
  v.transform(({ bytes, type, ...rest }) => ({ ...rest, file: new Blob([bytes], { type }) })),
);

const leaderFile = v.object({ name: text, bytes: v.instance(Uint8Array<ArrayBuffer>) });

const degrees = v.pipe(v.number(), v.minValue(-360), v.maxValue(360));
const metres = v.pipe(v.number(), v.minValue(-1000), v.maxValue(1000));

/** See `ImportOptions`; what does not fit is found in the file instead, as if it had not been set. */
const options = v.object({
  fps: v.fallback(v.optional(v.pipe(amount, v.gtValue(0))), undefined),
  unit: v.fallback(v.optional(v.picklist(ALL_UNITS.map((unit) => unit.name))), undefined),
  up: v.fallback(v.optional(v.picklist(UP_AXES.map((axis) => axis.name))), undefined),
  turn: v.fallback(v.optional(degrees), undefined),
  floor: v.fallback(v.optional(metres), undefined),
  part: v.fallback(v.optional(count), undefined),
  joints: v.fallback(v.optional(v.record(v.picklist(SMPL22), v.nullable(text))), undefined),
});

export const leader = v.object({
  id,
  name: text,
  label,
  files: v.pipe(
    v.array(leaderFile),
    v.minLength(1),
    v.maxLength(MAX_LEADER_FILES),
    // Only the first one is the motion: the others may be empty.
    v.check(([first]) => first !== undefined && first.bytes.byteLength > 0),
  ),
  options,
});

const floats = v.instance(Float32Array);

export const motion = v.object({
  id,
  motion: v.pipe(
    v.object({
      fps: v.pipe(amount, v.gtValue(0)),
      frames: v.pipe(count, v.minValue(1)),
      fitError: amount,
      offsets: floats,
      root: floats,
      rotations: floats,
      positions: floats,
    }),
    v.check((dance) => isDance(dance)),
  ),
  // Without latents a take is whole; only its coarse layer can't be shown.
  latents: v.fallback(
    v.optional(
      v.object({
        decoder: id,
        values: v.pipe(
          floats,
          v.check((values) => values.every(Number.isFinite)),
        ),
      }),
    ),
    undefined,
  ),
});

/** See `ModelIdentity`. */
const model = v.object({ id, name: text, graphs: v.pipe(v.array(text), v.maxLength(MAX_GRAPHS)) });

export const take = v.object({
  id,
  number: count,
  name: v.nullable(
    v.pipe(
      v.string(),
      v.minLength(1),
      v.transform((name) => name.slice(0, MAX_TAKE_NAME_LENGTH)),
    ),
  ),
  starred: v.boolean(),
  createdAt: v.pipe(v.number(), v.minValue(0), v.maxValue(MAX_DATE)),
  label,
  seconds: v.nullable(amount),
  model: v.fallback(v.optional(model), undefined),
  unfamiliarity: v.fallback(v.optional(amount), undefined),
  motion: id,
  leader: id,
  song: v.nullable(id),
  inputs,
});

/** How a song is counted. */
const counting = v.object({
  song: text,
  bytes: v.pipe(v.number(), v.integer(), v.minValue(0)),
  beatsPerBar: v.picklist([3, 4]),
  rate: v.picklist([0.5, 1, 2]),
  one: v.pipe(v.number(), v.minValue(-MAX_SECONDS), v.maxValue(MAX_SECONDS)),
});

/** A part of the dance, seconds. */
const region = v.pipe(
  v.object({ from: amount, to: amount }),
  v.check(({ from, to }) => to >= from + MIN_LOOP),
);

const radians = v.pipe(v.number(), v.minValue(-MAX_HEADING), v.maxValue(MAX_HEADING));
const place = v.pipe(v.number(), v.minValue(-MAX_PAN), v.maxValue(MAX_PAN));

/** See `Framing`. */
const framing = v.object({
  view: v.picklist(VIEWS),
  shot: v.object({
    target: v.tuple([place, place, place]),
    distance: v.pipe(v.number(), v.minValue(MIN_DISTANCE), v.maxValue(MAX_PAN)),
    heading: radians,
    elevation: v.pipe(v.number(), v.minValue(-Math.PI / 2), v.maxValue(Math.PI / 2)),
  }),
  tracked: v.tuple([place, place]),
  ownDistance: v.boolean(),
  ownHeading: v.boolean(),
  aspect: v.pipe(v.number(), v.minValue(1e-2), v.maxValue(1e2)),
});

/** Each of these takes its neutral value where it does not fit: the page is made of takes, and they can be chosen. */
export const page = v.object({
  leader: v.fallback(v.nullable(id), null),
  song: v.fallback(v.nullable(id), null),
  inputs: v.fallback(v.nullable(inputs), null),
  shown: v.fallback(v.nullable(id), null),
  other: v.fallback(v.nullable(id), null),
  letter: v.fallback(v.picklist(['A', 'B']), 'A'),
  compare: v.fallback(v.picklist(['off', 'side', 'ghost']), 'off'),
  takesMade: v.fallback(count, 0),
  footLock: v.fallback(v.boolean(), true),
  countings: v.fallback(v.pipe(v.array(counting), v.maxLength(MAX_FILES)), []),
  time: v.fallback(amount, 0),
  region: v.fallback(v.nullable(region), null),
  loop: v.fallback(v.boolean(), false),
  framing: v.fallback(v.nullable(framing), null),
});

/** Whether all arrays have the length of the frames, and numbers that a dancer's skeleton can have. */
function isDance(motion: SolvedMotion): boolean {
  const { frames, offsets, root, rotations, positions } = motion;
  const lengths =
    offsets.length === JOINT_COUNT * 3 &&
    root.length === frames * 3 &&
    rotations.length === frames * JOINT_COUNT * 4 &&
    positions.length === frames * JOINT_COUNT * 3;
  if (!lengths || !offsets.every((offset) => Math.abs(offset) <= MAX_BONE)) return false;
  for (let at = 0; at < rotations.length; at += 4) {
    const [x, y, z, w] = [rotations[at]!, rotations[at + 1]!, rotations[at + 2]!, rotations[at + 3]!];
    if (!(Math.abs(Math.hypot(x, y, z, w) - 1) <= MAX_ROTATION_ERROR)) return false;
  }
  for (let frame = 0; frame < frames; frame++)
    for (let axis = 0; axis < 3; axis++) {
      const pelvis = positions[(frame * JOINT_COUNT + J.pelvis) * 3 + axis]!;
      if (!(Math.abs(root[3 * frame + axis]! - pelvis) <= MAX_ROOT_ERROR)) return false;
    }
  try {
    checkPlausible(motion);
    return true;
  } catch {
    return false;
  }
}
