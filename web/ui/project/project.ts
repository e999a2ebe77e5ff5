import type { Framing } from '../../common/framing';
import { randomSeed } from '../store/actions/settings';
import type { Files, FileReaders } from '../store/services';
import { leaderlessProblem, projectProblem } from '../store/problems';
import { counted, fileSlug } from '../store/format';
import type { Take } from '../store/reaction';
import type { AppState } from '../store/state';
import { firstVisitEnded, givenSet } from '../store/actions/files';
import { countingsRestored } from '../store/actions/counting';
import { apply, type Store } from '../store/store';
import { toastShown, problemClosed, noticeAdded, problemShown } from '../store/actions/notices';
import {
  nothingRestored,
  persistenceAnswered,
  projectCleared,
  projectOpened,
  restoringSet,
  songRestored,
  takesMerged,
  takesRestored,
  visitRestored,
} from '../store/actions/project';
import { askPersistence, isPersistent, type Persistence } from '../../offline/persistence';
import { Autosave } from './autosave';
import type { TabLockApis } from './tab-lock';
import { checked } from './records';
import { assignId, loadedParts, storedProject } from './stored-project';
import { readProject, writeProject } from './project-file';
import { Restorer, restoringOf, type StoredFileReaders } from './restore';
import type { ProjectStorage } from './storage';
import { AppError } from '../../common/error';

/** What is needed of the stage. */
interface ProjectStage {
  readonly framing: () => Framing;
  readonly frameAs: (framing: Framing) => void;
  /** Resolves when the couple is drawn. */
  readonly ready: () => Promise<void>;
}

/** What the browser gives the page to store with, and the stage. */
export interface ProjectMeans {
  /** Null where there is none. */
  readonly stage: () => ProjectStage | null;
  readonly storage: ProjectStorage;
  readonly tabs: TabLockApis;
  readonly persistence: Persistence;
}

/** Songs, leaders, takes and settings between two visits, in the browser's storage, and in project files. */
export class Project {
  private readonly autosave: Autosave;
  /** Reads with progress in the bar: a failure is reported, and a newer file of the visitor's wins. */
  private readonly foreground: StoredFileReaders;
  /** Reads without changing the page; null for what fails. */
  private readonly background: StoredFileReaders;
  private persistenceAsked = false;
  /** The project that was asked for last; an older one that is still being read gives way. */
  private opening: File | null = null;
  /** Settles when all of an earlier visit is on the page. */
  private restored: Promise<void> = Promise.resolve();
  /** Resolves when the couple of an earlier visit is drawn, or there is none to draw. */
  coupleShown: Promise<void> = Promise.resolve();

  constructor(
    private readonly store: Store,
    private readonly files: Files,
    private readonly readers: FileReaders,
    private readonly means: ProjectMeans,
  ) {
    this.autosave = new Autosave(store, means.storage, means.tabs, {
      merge: (synced) => this.merge(synced),
      framing: this.framing,
      takeStored: () => void this.askPersistence(),
    });
    this.foreground = {
      song: ({ file, name, label }) => files.readSong(file, name, label, this.coupleShown),
      leader: ({ name, label, files: leader, options }) =>
        files.readLeader({ name, label, files: leader, options }),
    };
    this.background = backgroundReaders(readers);
  }

  /**
   * Restores what an earlier visit stored and starts autosave; false when there is nothing to restore. What is there is
   * said at once, the couple is drawn as soon as the leader is read, and the song and the other takes come after it.
   */
  restore(): Promise<boolean> {
    let shown = (): void => undefined;
    this.coupleShown = new Promise((resolve) => (shown = resolve));
    const visit = this.restoreVisible(shown).finally(shown);
    this.restored = visit.then((restorer) => (restorer ? this.restoreRest(restorer) : undefined));
    return visit.then((restorer) => restorer !== null);
  }

  /**
   * @param shown called when the couple is drawn, or could not be read
   * @returns what is left to restore; null when there is nothing to restore
   */
  private async restoreVisible(shown: () => void): Promise<Restorer | null> {
    const { store } = this;
    const found = await this.autosave.read();
    const { project, losses } = found ? checked(found) : NOTHING;
    for (const loss of losses) apply(store, noticeAdded(loss));
    if (!project || (project.leaders.length === 0 && project.songs.length === 0)) {
      apply(store, nothingRestored());
      this.autosave.start();
      return null;
    }
    void isPersistent(this.means.persistence).then((answer) => apply(store, persistenceAnswered(answer)));
    apply(store, firstVisitEnded());
    apply(store, restoringSet(restoringOf(project)));
    const restorer = new Restorer(project, assignId);
    const song = restorer.readPageSong(this.foreground);
    await this.restoreCouple(restorer).finally(shown);
    await song;
    this.showPageSong(restorer);
    this.autosave.start();
    return restorer;
  }

  /** Opens a project file in place of everything; false when that fails, which is reported in the store. */
  async open(file: File): Promise<boolean> {
    const { store } = this;
    apply(store, problemClosed());
    apply(store, givenSet(null));
    this.opening = file;
    const isNewest = (): boolean => this.opening === file;
    try {
      const { project, losses } = readProject(new Uint8Array(await file.arrayBuffer()));
      // What came later would be mixed with what is opened, and undo would not bring it back.
      await this.restored.catch(() => undefined);
      if (!isNewest()) return false;
      apply(store, restoringSet(restoringOf(project)));
      // What is still being read was asked for before.
      this.files.cancel('leader');
      this.files.cancel('song');
      const before = store.getState();
      const restorer = new Restorer(project);
      await Promise.all([
        this.readers.manifest(),
        restorer.readPageLeader(this.foreground),
        restorer.readPageSong(this.foreground),
      ]);
      await restorer.readRest(this.background);
      const now = store.getState();
      // Files that the visitor has chosen in the meantime are the newer request.
      const isNewerAsked = now.leader !== before.leader || now.song !== before.song || now.asked.length > 0;
      if (!isNewest() || isNewerAsked) return false;
      const content = restorer.content(now);
      if (project.page.leader !== null && !content.leader) return false;
      apply(store, projectOpened(content));
      this.frame(project.page.framing);
      apply(store, toastShown(openedText(store.getState())));
      for (const loss of [...losses, ...restorer.losses()]) apply(store, noticeAdded(loss));
      if (!content.leader) apply(store, problemShown(leaderlessProblem(file.name)));
      return true;
    } catch (error) {
      apply(store, problemShown(projectProblem(error, file.name, 'any-file')));
      return false;
    } finally {
      if (isNewest()) apply(store, restoringSet(null));
    }
  }

  /** Lets this tab store its work instead of the tab that does; what that one has stored comes onto this page too. */
  readonly takeOver = (): void => void this.autosave.takeOver();

  /** The project file of everything on the page; null when writing it fails, which is reported in the store. */
  async toFile(): Promise<{ readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } | null> {
    const state = this.store.getState();
    try {
      return { name: projectName(state), bytes: await writeProject(storedProject(state, this.framing())) };
    } catch (cause) {
      const error =
        cause instanceof AppError
          ? cause
          : new AppError(
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
    this.files.cancel('leader');
    this.files.cancel('song');
    this.autosave.clear();
    apply(this.store, projectCleared(this.store.getState().manifest, randomSeed()));
  }

  dispose(): void {
    this.autosave.dispose();
  }

  private readonly framing = (): Framing | null => this.means.stage()?.framing() ?? null;

  /** Frames the couple as in an earlier visit. */
  private frame(framing: Framing | null): void {
    if (framing) this.means.stage()?.frameAs(framing);
  }

  private showPageSong(restorer: Restorer): void {
    const read = restorer.pageSong();
    if (read) apply(this.store, songRestored(read.song, read.takes));
  }

  /** Reads the page's leader and shows what was on the page with it, until the couple is drawn. */
  private async restoreCouple(restorer: Restorer): Promise<void> {
    const { store } = this;
    const before = store.getState();
    await Promise.all([this.readers.manifest(), restorer.readPageLeader(this.foreground)]);
    const now = store.getState();
    const { countings = [], ...content } = restorer.content(now);
    // Files that the visitor has chosen in the meantime stay.
    if (now.leader !== before.leader || now.takes.length > 0)
      apply(store, takesRestored(content.takes ?? []));
    else {
      const isSongNewer = now.song !== before.song;
      apply(store, visitRestored({ ...content, ...(isSongNewer && { song: now.song, shift: 0 }) }));
      this.frame(restorer.stored.page.framing);
    }
    apply(store, countingsRestored(countings));
    // The work comes back also where a body can't be drawn.
    await this.means
      .stage()
      ?.ready()
      .catch(() => undefined);
  }

  /** Restores the takes of other songs and leaders than the page's. */
  private async restoreRest(restorer: Restorer): Promise<void> {
    const { store } = this;
    const there = new Set(restorer.takes(store.getState()).map(({ id }) => id));
    await restorer.readRest(this.background);
    // A take that was there may have been deleted since.
    const rest = restorer.takes(store.getState()).filter(({ id }) => !there.has(id));
    apply(store, takesRestored(rest));
    this.showPageSong(restorer);
    apply(store, restoringSet(null));
    this.autosave.noteSynced();
    for (const loss of restorer.losses()) apply(store, noticeAdded(loss));
  }

  /** Puts the takes on the page that another tab has stored since this one last did. */
  private async merge(synced: readonly Take[]): Promise<void> {
    const { store } = this;
    const found = await this.means.storage.read();
    if (!found) return;
    await this.readers.manifest();
    const restorer = new Restorer(checked(found).project, assignId, loadedParts(store.getState()));
    await restorer.readRest(this.background);
    apply(store, takesMerged(restorer.takes(store.getState()), synced));
  }

  private async askPersistence(): Promise<void> {
    if (this.persistenceAsked) return;
    this.persistenceAsked = true;
    const answer = await askPersistence(this.means.persistence);
    apply(this.store, persistenceAnswered(answer));
  }
}

const NOTHING = { project: null, losses: [] };

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
  const parts = [song && fileSlug(song.name, 'song'), leader && fileSlug(leader.name, 'leader')];
  return `${parts.filter(Boolean).join('_') || 'project'}.reactdance`;
}

/** `Opened: descarga.mp3, leader_0412.bvh, 3 takes`. */
export function openedText({ song, leader, takes }: Pick<AppState, 'song' | 'leader' | 'takes'>): string {
  const count = takes.length > 0 ? counted(takes.length, 'take') : 'no takes';
  return `Opened: ${[song?.name ?? 'no song', leader?.name ?? 'no leader', count].join(', ')}`;
}
