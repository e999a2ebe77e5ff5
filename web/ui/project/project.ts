import { randomSeed } from '../store/actions/settings';
import type { Files, FileReaders } from '../store/services';
import { projectProblem } from '../store/problems';
import { slug } from '../store/format';
import type { AppState } from '../store/state';
import { firstVisitEnded } from '../store/actions/files';
import { apply, type Store } from '../store/store';
import { toastShown, problemClosed, noticeAdded, problemShown } from '../store/actions/notices';
import { projectCleared, projectOpened, takesRestored, visitRestored } from '../store/actions/project';
import { Autosave } from './autosave';
import { assignId, storedProject } from './schema';
import { readProject, writeProject } from './project-file';
import { Restorer, type StoredFileReaders } from './restore';
import type { ProjectStorage } from './storage';
import { AppError } from '../../common/error';

/** Songs, leaders, takes and settings between two visits, in the browser's storage, and in project files. */
export class Project {
  private readonly autosave: Autosave;
  /** Reads with progress in the bar: a failure is reported, and a newer file of the visitor's wins. */
  private readonly foreground: StoredFileReaders;
  /** Reads without changing the page; null for what fails. */
  private readonly background: StoredFileReaders;

  constructor(
    private readonly store: Store,
    files: Files,
    private readonly readers: FileReaders,
    storage: ProjectStorage,
  ) {
    this.autosave = new Autosave(store, storage);
    this.foreground = {
      song: ({ file, name, label }) => files.readSong(file, name, label),
      leader: ({ name, label, files: leader, options }) =>
        files.readLeader({ name, label, files: leader, options }),
    };
    this.background = backgroundReaders(readers);
  }

  /** Restores what an earlier visit stored and starts autosave; false when there is nothing to restore. */
  async restore(): Promise<boolean> {
    const { store } = this;
    const stored = await this.autosave.read();
    if (!stored) {
      this.autosave.start();
      return false;
    }
    apply(store, firstVisitEnded());
    const before = store.getState();
    await this.readers.manifest();
    const restorer = new Restorer(stored, assignId);
    await restorer.readPage(this.foreground);
    const now = store.getState();
    // Files that the visitor has chosen in the meantime stay.
    const superseded = now.leader !== before.leader || now.song !== before.song || now.takes.length > 0;
    const content = restorer.content(now);
    apply(store, superseded ? takesRestored(content.takes ?? []) : visitRestored(content));
    this.autosave.start();
    void restorer.readRest(this.background).then(() => {
      apply(store, takesRestored(restorer.content(store.getState()).takes ?? []));
      for (const loss of restorer.losses()) apply(store, noticeAdded(loss));
    });
    return true;
  }

  /** Opens a project file in place of everything; false when that fails, which is reported in the store. */
  async open(file: File): Promise<boolean> {
    const { store } = this;
    apply(store, problemClosed());
    try {
      const stored = readProject(new Uint8Array(await file.arrayBuffer()));
      await this.readers.manifest();
      const before = store.getState();
      const restorer = new Restorer(stored);
      await restorer.readPage(this.foreground);
      await restorer.readRest(this.background);
      const now = store.getState();
      // Files that the visitor has chosen in the meantime are the newer request.
      if (now.leader !== before.leader || now.song !== before.song) return false;
      const content = restorer.content(now);
      if (stored.page.leader !== null && !content.leader) return false;
      apply(store, projectOpened(content));
      apply(store, toastShown(openedText(store.getState())));
      for (const loss of restorer.losses()) apply(store, noticeAdded(loss));
      return true;
    } catch (error) {
      apply(store, problemShown(projectProblem(error, file.name, 'any-file')));
      return false;
    }
  }

  /** The project file of everything on the page; null when writing it fails, which is reported in the store. */
  async toFile(): Promise<{ readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } | null> {
    const state = this.store.getState();
    try {
      return { name: projectName(state), bytes: await writeProject(storedProject(state)) };
    } catch {
      const error = new AppError(
        'too-large',
        'The project could not be written.',
        'Delete some takes, or close other tabs, and save again.',
      );
      apply(this.store, problemShown(projectProblem(error, projectName(state), 'none')));
      return null;
    }
  }

  /** Empties the page and, by autosave, the storage; undo brings everything back. */
  clear(): void {
    apply(this.store, projectCleared(this.store.getState().manifest, randomSeed()));
  }

  dispose(): void {
    this.autosave.dispose();
  }
}

function backgroundReaders(readers: FileReaders): StoredFileReaders {
  return {
    song: async ({ file, name, label }) => {
      const { audio } = await readers.manifest();
      const options = { signal: new AbortController().signal, onProgress: () => undefined };
      return readers.loadSong(file, audio, options).then(
        (data) => ({ name, label, file, data }),
        () => null,
      );
    },
    leader: ({ name, label, files, options }) =>
      readers.readLeader({ files, options }, new AbortController().signal).then(
        ({ file, motion }) => ({ name, label, files, options, file, motion }),
        () => null,
      ),
  };
}

/** `descarga_leader-0412.reactdance`. */
function projectName({ song, leader }: AppState): string {
  const parts = [song && slug(song.name, 'song'), leader && slug(leader.name, 'leader')];
  return `${parts.filter(Boolean).join('_') || 'project'}.reactdance`;
}

/** `Opened: descarga.mp3, leader_0412.bvh, 3 takes`. */
export function openedText({ song, leader, takes }: Pick<AppState, 'song' | 'leader' | 'takes'>): string {
  const count = takes.length === 1 ? '1 take' : `${takes.length || 'no'} takes`;
  return `Opened: ${[song?.name ?? 'no song', leader?.name ?? 'no leader', count].join(', ')}`;
}
