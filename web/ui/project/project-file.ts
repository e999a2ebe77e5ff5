import { strFromU8, strToU8, type Unzipped, unzipSync, type Zippable, zipSync } from 'fflate';
import * as v from 'valibot';
import { fileSlug } from '../store/format';
import { checked } from './records';
import { type StoredProject, VERSION } from './stored-project';
import { motionBytes, packFloats, packMotion, unpackFloats, unpackMotion } from './motion-bytes';
import { AppError } from '../../common/error';

const FORMAT = 'reactdance-project';
const MANIFEST = 'project.json';

/** Most bytes of an archive's files together; a small archive can claim to hold any number. */
const MAX_BYTES = 2 ** 30;

const list = v.array(v.unknown());

/** project.json: the page, the takes, and which file of the archive holds what. Each entry is checked by itself. */
const schema = v.object({
  format: v.literal(FORMAT),
  version: v.number(),
  songs: list,
  leaders: list,
  motions: list,
  takes: list,
  page: v.unknown(),
});

type Manifest = v.InferOutput<typeof schema>;

/**
 * Writes a project: a zip archive with project.json, songs and leaders as they were given, and motion and latents of
 * takes as float32.
 * @throws {AppError} `too-large` where it could not be read again
 */
export async function writeProject(project: StoredProject): Promise<Uint8Array<ArrayBuffer>> {
  const files: Zippable = {};
  // Songs are compressed already, and motion hardly shrinks.
  let total = 0;
  const add = (file: string, bytes: Uint8Array, level: 0 | 1): string => {
    if ((total += bytes.length) > MAX_BYTES)
      throw new AppError(
        'too-large',
        `The project has more than ${Math.round(MAX_BYTES / 1e6)} MB.`,
        'Delete takes of long songs, and save again.',
      );
    files[file] = [bytes, { level }];
    return file;
  };
  const songs: unknown[] = [];
  for (const [index, { id, name, label, file }] of project.songs.entries()) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const ending = /\.[a-z0-9]{1,5}$/i.exec(name)?.[0] ?? '';
    const path = `songs/${index + 1}-${fileSlug(name, 'song')}${ending}`;
    songs.push({ id, name, label, type: file.type, file: add(path, bytes, 0) });
  }
  const leaders = project.leaders.map(({ id, name, label, files: parts, options }, index) => {
    const folder = project.leaders.length === 1 ? '' : 'leaders/';
    const [file, ...companions] = parts.map((part, place) => {
      const ending = /\.[a-z0-9]{1,5}$/i.exec(part.name)?.[0].toLowerCase() ?? '';
      const stem = folder === '' ? 'leader' : `${index + 1}-${fileSlug(name, 'leader')}`;
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
  const manifest: Manifest = {
    format: FORMAT,
    version: VERSION,
    songs,
    leaders,
    motions,
    takes: [...project.takes],
    page: project.page,
  };
  add(MANIFEST, strToU8(JSON.stringify(manifest, null, 2)), 1);
  return zipSync(files);
}

/**
 * Reads a project; entries that do not fit are left out and said, see `checked`.
 * @throws {AppError} what is wrong with the file
 */
export function readProject(bytes: Uint8Array): ReturnType<typeof checked> {
  const files = unzip(bytes);
  const { songs, leaders, motions, takes, page } = readManifest(files);
  const read = checked({
    songs: songs.map((entry) => withFile(entry, files, (content) => ({ bytes: content }))),
    leaders: leaders.map((entry) =>
      withFile(entry, files, (content) => leaderOf(entry as Entry, content, files)),
    ),
    motions: motions.map((entry) =>
      withFile(entry, files, (content) => motionOf(entry as Entry, content, files)),
    ),
    takes,
    page,
  });
  const { project, losses } = read;
  if (project.songs.length > 0 || project.leaders.length > 0) return read;
  throw new AppError(
    'damaged-project',
    `The project holds no song and no leader that can be read. ${losses.join(' ')}`.trim(),
    HINT_AGAIN,
  );
}

type Entry = Readonly<Record<string, unknown>>;

/** An entry with what its file in the archive holds; as it is, and thus incomplete, where there is no such file. */
function withFile(
  entry: unknown,
  files: Unzipped,
  read: (content: Uint8Array<ArrayBuffer>) => Entry,
): unknown {
  if (entry === null || typeof entry !== 'object') return entry;
  const { file, ...rest } = entry as Entry;
  const content = contentOf(files, file);
  return content ? { ...rest, ...read(content) } : rest;
}

function contentOf(files: Unzipped, file: unknown): Uint8Array<ArrayBuffer> | null {
  return typeof file === 'string' && Object.hasOwn(files, file) ? files[file]! : null;
}

/** Files of earlier pages have the frame rate alone, beside the file. */
function leaderOf({ name, fps, companions, options }: Entry, content: Uint8Array, files: Unzipped): Entry {
  const others = Array.isArray(companions) ? (companions as readonly unknown[]) : [];
  return {
    files: [
      { name, bytes: content },
      ...others.map((other) => withFile(other, files, (bytes) => ({ bytes }))),
    ],
    options: { ...(typeof fps === 'number' && { fps }), ...(options as object | null | undefined) },
  };
}

function motionOf({ frames, fps, fitError, latents }: Entry, content: Uint8Array, files: Unzipped): Entry {
  if (typeof frames !== 'number' || content.byteLength !== motionBytes(frames)) return {};
  const motion = unpackMotion(content, { frames, fps: fps as number, fitError: fitError as number });
  if (latents === null || typeof latents !== 'object') return { motion };
  const { decoder, count, file } = latents as Entry;
  const values = contentOf(files, file);
  const isWhole = values !== null && typeof count === 'number' && values.byteLength === 4 * count;
  return { motion, latents: isWhole ? { decoder, values: unpackFloats(values) } : undefined };
}

const HINT_AGAIN =
  'The file was changed or cut off after it was saved: copy or download it again. What is on the page stays.';
const HINT_SAVED = 'Open a file that was saved here with “Save project”. What is on the page stays.';

function unzip(bytes: Uint8Array): Unzipped {
  const isZip = bytes[0] === 0x50 && bytes[1] === 0x4b;
  if (!isZip) throw new AppError('not-a-project', 'The file is not a ReactDance project.', HINT_SAVED);
  let total = 0;
  const fits = ({ originalSize }: { readonly originalSize: number }): boolean =>
    (total += originalSize) <= MAX_BYTES;
  let files: Unzipped;
  try {
    files = unzipSync(bytes, { filter: fits });
  } catch {
    throw new AppError('damaged-project', 'The project is cut off or damaged.', HINT_AGAIN);
  }
  if (total <= MAX_BYTES) return files;
  throw new AppError(
    'too-large',
    `The project unpacks to ${Math.ceil(total / 1e6)} MB; up to ${Math.round(MAX_BYTES / 1e6)} MB are read.`,
    'Open a file that was saved here with “Save project”, with fewer or shorter songs. What is on the page stays.',
  );
}

function readManifest(files: Unzipped): Manifest {
  const content = files[MANIFEST];
  if (!content)
    throw new AppError(
      'not-a-project',
      `The archive holds no ${MANIFEST}, so it is not a project.`,
      HINT_SAVED,
    );
  let json: unknown;
  try {
    json = JSON.parse(strFromU8(content));
  } catch {
    throw new AppError('damaged-project', `${MANIFEST} in the project is not JSON.`, HINT_AGAIN);
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
