import { noneUsableProblem } from '../store/problems';
import { givenSet } from '../store/actions/files';
import { problemClosed, problemShown } from '../store/actions/notices';
import type { FileChoice, Files } from '../store/services';
import type { GivenFiles } from '../store/state';
import { apply, type Store } from '../store/store';
import { groupCompanions } from '../../motion/import/format';
import type { InOrder } from './dropped';
import { type FileKind, fileKind, HEAD_BYTES } from './file-type';

/** What a file is that can't be used. */
type Unusable = Exclude<FileKind, 'song' | 'leader' | 'video'> | 'empty' | 'unreadable';

/** What is said of one file of a kind, and of several. */
const SENTENCES: Readonly<
  Record<Unusable, { one: (name: string) => string; many: (count: number) => string }>
> = {
  picture: {
    one: (name) => `${name} is a picture.`,
    many: (count) => `${count} files are pictures.`,
  },
  empty: { one: (name) => `${name} is empty.`, many: (count) => `${count} files are empty.` },
  unreadable: {
    one: (name) => `${name} cannot be read: it may be a folder, or gone.`,
    many: (count) => `${count} files cannot be read: they may be folders, or gone.`,
  },
  unknown: {
    one: (name) => `${name} is neither a song, a video nor a motion.`,
    many: (count) => `${count} other files are neither songs, videos nor motions.`,
  },
};

/**
 * Opens what was given: a song, a leader or both at once, and where there is anything else, a list of all, from which
 * the visitor chooses. What can't be read is reported in the store.
 * @param inOrder so that what is given later is opened later
 */
export async function openGiven(
  files: readonly File[],
  store: Store,
  reader: Pick<Files, 'open'>,
  inOrder: InOrder,
  as?: FileChoice,
): Promise<void> {
  // Files from which nothing was chosen are no longer wanted.
  apply(store, givenSet(null));
  // What is wrong with a single file is said at length.
  const given = await inOrder(async () => (files.length === 1 ? null : sortedFiles(files)));
  if (!given) return reader.open(files, as);
  const { songs, leaders, unused } = given;
  apply(store, problemClosed());
  if (songs.length + leaders.length === 0)
    apply(store, problemShown(noneUsableProblem(files.length, unused)));
  else if (songs.length <= 1 && leaders.length <= 1 && unused.length === 0) await reader.open(files);
  else apply(store, givenSet(given));
}

/** Tells songs and leaders from the rest, of which it says in a sentence for each kind what it is. */
export async function sortedFiles(files: readonly File[]): Promise<GivenFiles> {
  const groups = groupCompanions(files);
  const kinds = await Promise.all(groups.map(([file]) => kindOf(file!)));
  const of = (kind: FileKind | Unusable): File[][] => groups.filter((_, i) => kinds[i] === kind);
  const unused = (Object.keys(SENTENCES) as Unusable[]).flatMap((kind) => {
    const [first, ...others] = of(kind);
    const { one, many } = SENTENCES[kind];
    if (!first) return [];
    return others.length === 0 ? one(first[0]!.name) : many(1 + others.length);
  });
  return { songs: of('song'), leaders: [...of('leader'), ...of('video')], unused };
}

async function kindOf(file: File): Promise<FileKind | Unusable> {
  if (file.size === 0) return 'empty';
  try {
    const head = new Uint8Array(await file.slice(0, HEAD_BYTES).arrayBuffer());
    return fileKind(head, file.name, file.type);
  } catch {
    return 'unreadable';
  }
}
