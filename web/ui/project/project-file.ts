import { strFromU8, strToU8, type Unzipped, unzipSync, type Zippable, zipSync } from 'fflate';
import * as v from 'valibot';
import { slug } from '../store/format';
import type { StoredProject, StoredInputs } from './schema';
import { motionBytes, packFloats, packMotion, unpackFloats, unpackMotion } from './motion-bytes';
import { AppError } from '../../common/error';

/** Raised when older pages can no longer read the file. */
const VERSION = 1;
const FORMAT = 'reactdance-project';
const MANIFEST = 'project.json';

const text = v.pipe(v.string(), v.minLength(1));
const label = v.nullable(v.string());
const count = v.pipe(v.number(), v.integer(), v.minValue(0));
const inputs = v.custom<StoredInputs>(
  (value) => value !== null && typeof value === 'object' && !Array.isArray(value),
);
const shape = {
  fps: v.pipe(v.number(), v.gtValue(0)),
  frames: v.pipe(count, v.minValue(1)),
  fitError: v.number(),
};

/** What is set by hand about a leader. Files of earlier pages have the frame rate alone, beside it. */
const options = v.optional(v.record(v.string(), v.unknown()), {});
const fps = v.optional(v.nullable(v.number()), null);
/** Files that belong to a leader's, as the skeleton of an AMC. */
const companions = v.optional(v.array(v.object({ name: text, file: text })), []);

/** The latents of a motion, in a file of their own. */
const latents = v.object({ decoder: text, count, file: text });

/** How a song is counted. */
const counting = v.object({
  song: text,
  bytes: count,
  beatsPerBar: v.picklist([3, 4]),
  rate: v.picklist([0.5, 1, 2]),
  one: v.pipe(v.number(), v.finite()),
});

/** project.json: the page, the takes, and which file of the archive holds what. */
const schema = v.object({
  format: v.literal(FORMAT),
  version: v.number(),
  songs: v.array(v.object({ id: text, name: text, label, type: v.string(), file: text })),
  leaders: v.array(v.object({ id: text, name: text, label, file: text, companions, options, fps })),
  motions: v.array(v.object({ id: text, file: text, ...shape, latents: v.optional(latents) })),
  takes: v.array(
    v.object({
      id: text,
      number: count,
      name: label,
      starred: v.boolean(),
      createdAt: v.number(),
      label,
      seconds: v.nullable(v.number()),
      motion: text,
      leader: text,
      song: v.nullable(text),
      inputs,
    }),
  ),
  page: v.object({
    leader: v.nullable(text),
    song: v.nullable(text),
    inputs: v.nullable(inputs),
    shown: v.nullable(text),
    other: v.nullable(text),
    letter: v.picklist(['A', 'B']),
    compare: v.picklist(['off', 'side', 'ghost']),
    takesMade: count,
    footLock: v.boolean(),
    countings: v.optional(v.array(counting), []),
    time: v.number(),
  }),
});

type Manifest = v.InferOutput<typeof schema>;

/**
 * Writes a project: a zip archive with project.json, the songs as they were given, leaders as they were given, motion and latents
 * of takes as float32.
 */
export async function writeProject(project: StoredProject): Promise<Uint8Array<ArrayBuffer>> {
  const files: Zippable = {};
  // Songs are compressed already, and motion hardly shrinks.
  const add = (file: string, bytes: Uint8Array, level: 0 | 1): string => {
    files[file] = [bytes, { level }];
    return file;
  };
  const songs: Manifest['songs'] = [];
  for (const [index, { id, name, label, file }] of project.songs.entries()) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const ending = /\.[a-z0-9]{1,5}$/i.exec(name)?.[0] ?? '';
    const path = `songs/${index + 1}-${slug(name, 'song')}${ending}`;
    songs.push({ id, name, label, type: file.type, file: add(path, bytes, 0) });
  }
  const leaders = project.leaders.map(({ id, name, label, files: parts, options }, index) => {
    const folder = project.leaders.length === 1 ? '' : 'leaders/';
    const [file, ...companions] = parts.map((part, place) => {
      const ending = /\.[a-z0-9]{1,5}$/i.exec(part.name)?.[0].toLowerCase() ?? '';
      const stem = folder === '' ? 'leader' : `${index + 1}-${slug(name, 'leader')}`;
      const path = `${folder}${stem}${place > 0 ? `-${place + 1}` : ''}${ending}`;
      return { name: part.name, file: add(path, part.bytes, 1) };
    });
    return { id, name, label, file: file!.file, companions, options: { ...options }, fps: null };
  });
  const motions = project.motions.map(({ id, motion, latents }, index) => {
    const { fps, frames, fitError } = motion;
    const path = `takes/${index + 1}`;
    return {
      ...{ id, fps, frames, fitError, file: add(`${path}.f32`, packMotion(motion), 0) },
      latents: latents && {
        decoder: latents.decoder,
        count: latents.values.length,
        file: add(`${path}-latents.f32`, packFloats(latents.values), 0),
      },
    };
  });
  const manifest = {
    format: FORMAT,
    version: VERSION,
    songs,
    leaders,
    motions,
    takes: project.takes,
    page: project.page,
  };
  add(MANIFEST, strToU8(JSON.stringify(manifest, null, 2)), 1);
  return zipSync(files);
}

/**
 * Reads a project.
 * @throws {AppError} what is wrong with the file, and which part of it
 */
export function readProject(bytes: Uint8Array): StoredProject {
  const files = unzip(bytes);
  const manifest = readManifest(files);
  const part = (file: string): Uint8Array<ArrayBuffer> => {
    const content = files[file];
    if (content) return content;
    throw new AppError('missing-part', `The project lacks its part ${file}.`, HINT_AGAIN);
  };
  const partOf = (file: string, bytes: number, what: string): Uint8Array<ArrayBuffer> => {
    const content = part(file);
    if (content.byteLength === bytes) return content;
    throw new AppError(
      'damaged-project',
      `${file} in the project has ${content.byteLength} bytes where ${what} have ${bytes}.`,
      HINT_AGAIN,
    );
  };
  return {
    songs: manifest.songs.map(({ id, name, label, type, file }) => ({
      id,
      name,
      label,
      file: new Blob([part(file)], { type }),
    })),
    leaders: manifest.leaders.map(({ id, name, label, fps, file, companions, options }) => ({
      id,
      name,
      label,
      files: [{ name, file }, ...companions].map((one) => ({ name: one.name, bytes: part(one.file) })),
      options: { ...(fps !== null && { fps }), ...options },
    })),
    motions: manifest.motions.map(({ id, fps, frames, fitError, file, latents }) => {
      const content = partOf(file, motionBytes(frames), `${frames} frames`);
      const motion = unpackMotion(content, { fps, frames, fitError });
      if (!latents) return { id, motion };
      const { decoder, count } = latents;
      const values = unpackFloats(partOf(latents.file, 4 * count, `${count} latents`));
      return { id, motion, latents: { decoder, values } };
    }),
    takes: manifest.takes,
    page: manifest.page,
  };
}

const HINT_AGAIN =
  'The file was changed or cut off after it was saved: copy or download it again. What is on the page stays.';
const HINT_SAVED = 'Open a file that was saved here with “Save project”. What is on the page stays.';

function unzip(bytes: Uint8Array): Unzipped {
  const isZip = bytes[0] === 0x50 && bytes[1] === 0x4b;
  if (!isZip) throw new AppError('not-a-project', 'The file is not a ReactDance project.', HINT_SAVED);
  try {
    return unzipSync(bytes);
  } catch {
    throw new AppError('damaged-project', 'The project is cut off or damaged.', HINT_AGAIN);
  }
}

function readManifest(files: Unzipped): Manifest {
  const content = files[MANIFEST];
  if (!content)
    throw new AppError('not-a-project', `The archive holds no ${MANIFEST}, so it is no project.`, HINT_SAVED);
  let json: unknown;
  try {
    json = JSON.parse(strFromU8(content));
  } catch {
    throw new AppError('damaged-project', `${MANIFEST} in the project is no JSON.`, HINT_AGAIN);
  }
  const header = v.safeParse(v.object({ format: v.literal(FORMAT), version: v.number() }), json);
  if (header.success && header.output.version > VERSION)
    throw new AppError(
      'newer-project',
      'The project was saved by a newer version of this page.',
      'Reload the page to get the newest version, then open it again.',
    );
  const result = v.safeParse(schema, json);
  if (result.success) return result.output;
  const [issue] = result.issues;
  const where = v.getDotPath(issue) ?? 'its top';
  throw new AppError(
    'damaged-project',
    `${MANIFEST} in the project is not as it was written (${where}: ${issue.message}).`,
    HINT_AGAIN,
  );
}
