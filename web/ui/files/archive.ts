import { type Unzipped, unzipSync, type UnzipFileFilter } from 'fflate';
import { AppError } from '../../common/error';
import { yieldToPage } from '../../common/yield-to-events';
import type { DroppedFile } from '../store/services';
import { isProject } from './file-type';

/** Most bytes that an archive may unpack to. */
const MAX_BYTES = 256 * 1024 ** 2;
/** Bytes from which on the page gets a turn before the next file is unpacked. */
const BATCH_BYTES = 8 * 1024 ** 2;

/**
 * Files with those of zip archives in the place of the archives: collections of motions come so, and the BVH of two
 * dancers that the page writes. Archives in archives stay packed.
 *
 * @param onArchive is told the name of an archive before it is unpacked
 * @throws {AppError} `archive-damaged`, `archive-empty`, `archive-too-large`
 */
export async function unpacked(
  files: readonly DroppedFile[],
  onArchive: (name: string) => void = () => undefined,
): Promise<DroppedFile[]> {
  const found: DroppedFile[] = [];
  for (const one of files) {
    const packed = await isArchive(one.file);
    if (packed) onArchive(one.file.name);
    found.push(...(packed ? await contentOf(one) : [one]));
  }
  return found;
}

/** Whether a file is a zip archive, by name and content: NPZ files and projects are such archives too. */
async function isArchive(file: File): Promise<boolean> {
  if (!/\.zip$/i.test(file.name) || isProject(file.name)) return false;
  // What can't be read is told where it is opened.
  const head = await file
    .slice(0, 2)
    .text()
    .catch(() => '');
  return head === 'PK';
}

async function contentOf({ path, file }: DroppedFile): Promise<DroppedFile[]> {
  if (file.size > MAX_BYTES) throw tooLarge(file.name, file.size);
  const bytes = new Uint8Array(await file.arrayBuffer());
  const sizes = new Map<string, number>();
  unzip(bytes, file.name, ({ name, originalSize }) => {
    if (isContent(name)) sizes.set(name, originalSize);
    return false;
  });
  const total = [...sizes.values()].reduce((sum, size) => sum + size, 0);
  if (sizes.size === 0) throw empty(file.name);
  // A project that was renamed.
  if (sizes.has('project.json')) {
    const project = new File([file], file.name.replace(/\.zip$/i, '.reactdance'));
    return [{ path, file: project }];
  }
  if (total > MAX_BYTES) throw tooLarge(file.name, total);
  const found: DroppedFile[] = [];
  for (const batch of batchesOf(sizes)) {
    const contents = unzip(bytes, file.name, ({ name }) => batch.has(name));
    for (const name of batch) {
      const content = contents[name];
      // The library does not compare checksums.
      if (!content || content.length !== sizes.get(name)) throw damaged(file.name);
      found.push({ path: `${path}/${name}`, file: new File([content], name.split(/[\\/]/).at(-1)!) });
    }
    await yieldToPage();
  }
  return found;
}

/** Names of entries in their order, as many together as are unpacked while the page stands still. */
function batchesOf(sizes: ReadonlyMap<string, number>): Set<string>[] {
  const batches: Set<string>[] = [];
  let bytes = Infinity;
  for (const [name, size] of sizes) {
    bytes += size;
    if (bytes > BATCH_BYTES) {
      batches.push(new Set());
      bytes = size;
    }
    batches.at(-1)!.add(name);
  }
  return batches;
}

/** Whether an entry of an archive or a folder is a file that somebody put there: not a folder, nor what systems add. */
export function isContent(name: string): boolean {
  return !/[\\/]$|(^|[\\/])(\.|__MACOSX[\\/]|Thumbs\.db$|desktop\.ini$)/i.test(name);
}

function unzip(bytes: Uint8Array, name: string, filter: UnzipFileFilter): Unzipped {
  try {
    return unzipSync(bytes, { filter });
  } catch (cause) {
    throw damaged(name, { cause });
  }
}

function damaged(name: string, options?: ErrorOptions): AppError {
  return new AppError(
    'archive-damaged',
    `${name} cannot be unpacked: it is damaged, or protected by a password.`,
    'Unpack it with another program and choose a file from it, or download it again.',
    options,
  );
}

function empty(name: string): AppError {
  return new AppError(
    'archive-empty',
    `${name} holds no files.`,
    'Choose an archive with a song, a video or a motion file.',
  );
}

function tooLarge(name: string, bytes: number): AppError {
  return new AppError(
    'archive-too-large',
    `${name} unpacks to ${Math.ceil(bytes / 1e6)} MB or more; up to ${Math.floor(MAX_BYTES / 1e6)} MB are read.`,
    'Unpack it with another program and choose a file from it.',
  );
}
