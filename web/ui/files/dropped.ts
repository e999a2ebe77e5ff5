import type { ModelFolder } from '../../model/client';
import { problemShown, toastShown } from '../store/actions/notices';
import { archiveProblem, dropProblem, emptyDropProblem } from '../store/problems';
import type { DroppedFile, Files } from '../store/services';
import { apply, type Store } from '../store/store';
import { isContent, unpacked } from './archive';
import type { ModelLink } from './model-link';

/**
 * All files that were dropped, also those that somebody put into folders. To be called in the event's handler: after it
 * the list is empty.
 */
export async function droppedFiles(transfer: DataTransfer): Promise<DroppedFile[]> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry());
  const plain = [...transfer.files].map((file) => ({ path: file.name, file }));
  if (!entries.some((entry) => entry?.isDirectory)) return plain;
  const found = await Promise.all(entries.filter((entry) => entry !== null).map(filesBelow));
  // Whatever the folder itself is called.
  return found.flat().filter(({ path }) => isContent(path.replace(/^[^/]*\//, '')));
}

async function filesBelow(entry: FileSystemEntry): Promise<DroppedFile[]> {
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => {
      (entry as FileSystemFileEntry).file(resolve, reject);
    });
    return [{ path: entry.fullPath.replace(/^\//, ''), file }];
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const files: DroppedFile[] = [];
  // A reader returns the entries in batches, and an empty batch at the end.
  for (;;) {
    const batch = await new Promise<FileSystemEntry[]>((resolve, reject) => {
      reader.readEntries(resolve, reject);
    });
    if (batch.length === 0) return files;
    files.push(...(await Promise.all(batch.map(filesBelow))).flat());
  }
}

/** Runs jobs one after the other, in the order in which they were asked for. */
export type InOrder = <T>(job: () => Promise<T>) => Promise<T>;

export function createInOrder(): InOrder {
  let last: Promise<unknown> = Promise.resolve();
  return (job) => {
    const result = last.then(job);
    last = result.catch(() => undefined);
    return result;
  };
}

/** The model among dropped files: what lies beside and below a manifest.json; null without one. */
export function modelFolder(dropped: readonly DroppedFile[]): ModelFolder | null {
  const manifest = dropped.find(({ path }) => /(^|\/)manifest\.json$/.test(path));
  if (!manifest) return null;
  const root = manifest.path.slice(0, -'manifest.json'.length);
  const inside = dropped.filter(({ path }) => path.startsWith(root));
  return Object.fromEntries(inside.map(({ path, file }) => [path.slice(root.length), file]));
}

/**
 * Files with those of zip archives in the place of the archives; null where one can't be unpacked, which the store
 * reports.
 */
export async function unpackedOrReported(
  files: readonly DroppedFile[],
  store: Store,
): Promise<DroppedFile[] | null> {
  let toast: string | null = null;
  try {
    return await unpacked(files, (name) => {
      toast = `Unpacking ${name}`;
      apply(store, toastShown(toast));
    });
  } catch (error) {
    apply(store, problemShown(archiveProblem(error)));
    return null;
  } finally {
    if (toast !== null && store.getState().toast?.text === toast) apply(store, toastShown(null));
  }
}

/**
 * Opens what was dropped: the folder of a model, or songs and leaders. What can't be read is reported in the store.
 * @param generate generates a reaction with the model that was opened
 * @param inOrder so that what is dropped later is opened later, however long an archive takes
 */
export async function openDropped(
  reading: Promise<readonly DroppedFile[]>,
  store: Store,
  files: Pick<Files, 'open'>,
  model: Pick<ModelLink, 'open'>,
  generate: () => void,
  inOrder: InOrder,
): Promise<void> {
  const found = await inOrder(async () => {
    const dropped = await reading.catch((error: unknown) => {
      apply(store, problemShown(dropProblem(error)));
      return null;
    });
    return dropped && unpackedOrReported(dropped, store);
  });
  if (!found) return;
  const folder = modelFolder(found);
  if (found.length === 0) apply(store, problemShown(emptyDropProblem()));
  else if (!folder) await files.open(found.map(({ file }) => file));
  else if (await model.open(folder)) generate();
}
