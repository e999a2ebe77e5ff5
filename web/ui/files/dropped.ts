import type { DroppedFile } from '../store/services';
import type { ModelFolder } from '../../model/client';

/** Everything that was dropped, folders opened. Call it while the drop is handled: later the list is empty. */
export async function droppedFiles(transfer: DataTransfer): Promise<DroppedFile[]> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry());
  const plain = [...transfer.files].map((file) => ({ path: file.name, file }));
  if (!entries.some((entry) => entry?.isDirectory)) return plain;
  const found = await Promise.all(entries.filter((entry) => entry !== null).map(filesBelow));
  return found.flat();
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
  // A reader hands out a folder in portions and an empty one at its end.
  for (;;) {
    const portion = await new Promise<FileSystemEntry[]>((resolve, reject) => {
      reader.readEntries(resolve, reject);
    });
    if (portion.length === 0) return files;
    files.push(...(await Promise.all(portion.map(filesBelow))).flat());
  }
}

/** The model among dropped files: what lies beside and below a manifest.json; null without one. */
export function modelFolder(dropped: readonly DroppedFile[]): ModelFolder | null {
  const manifest = dropped.find(({ path }) => /(^|\/)manifest\.json$/.test(path));
  if (!manifest) return null;
  const root = manifest.path.slice(0, -'manifest.json'.length);
  const inside = dropped.filter(({ path }) => path.startsWith(root));
  return Object.fromEntries(inside.map(({ path, file }) => [path.slice(root.length), file]));
}
