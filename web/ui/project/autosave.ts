import { rolledSeed } from '../store/actions/settings';
import type { Files, Readers } from '../store/services';
import { fullProblem, projectProblem } from '../store/problems';
import { slug } from '../store/format';
import type { AppState, KeepingState } from '../store/state';
import { visitEnded } from '../store/actions/files';
import { apply, type Store } from '../store/store';
import { announced, dismissed, remarked, told } from '../store/actions/notices';
import { presentInputs } from '../store/take';
import {
  broughtBack,
  keepingChanged,
  projectOpened,
  startedAfresh,
  takesBroughtBack,
} from '../store/actions/project';
import { AppError } from '../../common/error';
import { type Kept, keep, knownAs, worthKeeping } from './schema';
import { readProject, writeProject } from './project-file';
import { type Rereaders, reviving } from './restore';
import { isFull, type Storage } from './storage';

/** Rest after the last change before it is written, milliseconds; a drag is written once. */
const REST = 700;
/** After a failure it is tried again this often, milliseconds: room may have been made elsewhere. */
const AGAIN = 20_000;

export interface Keeping {
  /** Brings back what an earlier visit left; false when there is nothing. What happens from then on is kept. */
  readonly restore: () => Promise<boolean>;
  /** Opens a project file in the place of everything; false when it can't be, which is told. */
  readonly openProject: (file: File) => Promise<boolean>;
  /** The project file of all that is here, or null when that failed, which is told. */
  readonly project: () => Promise<{ readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> } | null>;
  /** Empties the page and what is kept of it; undo brings it back. */
  readonly startAfresh: () => void;
  readonly dispose: () => void;
}

/** Keeps songs, leaders, takes and settings between visits and in project files. */
export function createKeeping(store: Store, files: Files, readers: Readers, storage: Storage): Keeping {
  /** In sight: with progress in the bar, a failure is told, and a newer file of the visitor's wins. */
  const inSight: Rereaders = {
    song: ({ file, name, label }) => files.readSong(file, name, label),
    leader: ({ text, name, label, fps }) => files.readLeader(text, name, label, fps),
  };
  /** Beside what goes on: what fails is a remark. */
  const aside: Rereaders = {
    song: async ({ file, name, label }) => {
      const { audio } = await readers.manifest();
      const options = { signal: new AbortController().signal, onProgress: () => undefined };
      return readers.loadSong(file, audio, options).then(
        (data) => ({ name, label, file, data }),
        () => null,
      );
    },
    leader: ({ text, name, label, fps }) =>
      readers.readLeader({ text, fps }, new AbortController().signal).then(
        ({ file, motion }) => ({ name, label, text, fps, file, motion }),
        () => null,
      ),
  };

  // ---- writing ----

  let timer: ReturnType<typeof setTimeout> | undefined;
  let unsubscribe = (): void => undefined;
  /** The parts that were written last, or are to be written when the timer runs out. */
  let seen: readonly unknown[] = [];
  let writing: Promise<void> = Promise.resolve();
  let anythingKept = false;
  /** Whether a write has ever fitted: who could never keep anything has nothing to lose by it. */
  let hasFitted = false;

  const writeAfter = (rest: number): void => {
    clearTimeout(timer);
    timer = setTimeout(write, rest);
  };
  const write = (): void => {
    clearTimeout(timer);
    timer = undefined;
    const state = store.getState();
    seen = keptParts(state);
    writing = writing.then(async () => {
      try {
        if (worthKeeping(state)) {
          anythingKept = true;
          await storage.write(keep(state));
          hasFitted = true;
          tell('kept');
        } else if (anythingKept) {
          await storage.clear();
          anythingKept = false;
          tell('kept');
        }
      } catch (error) {
        tell(isFull(error) ? 'full' : 'refused');
        // Unless a newer change is about to be written anyway.
        if (timer === undefined) writeAfter(AGAIN);
      }
    });
  };
  /** Says once that the space has become full, and stops saying so when there is room again. */
  const tell = (keeping: KeepingState): void => {
    if (store.getState().keeping === keeping) return;
    apply(store, keepingChanged(keeping));
    if (keeping === 'full' && hasFitted) apply(store, told(fullProblem()));
  };
  const begin = (): void => {
    write();
    unsubscribe = store.subscribe((state) => {
      const parts = keptParts(state);
      // The playhead moves all the time: what waits already must not wait for it to stop.
      if (parts.every((part, index) => part === seen[index])) return;
      seen = parts;
      writeAfter(REST);
    });
  };
  const onHide = (): void => {
    if (timer !== undefined && document.visibilityState === 'hidden') write();
  };
  globalThis.document?.addEventListener('visibilitychange', onHide);

  // ---- reading ----

  const stored = async (): Promise<Kept | null> => {
    try {
      return await storage.read();
    } catch {
      tell('refused');
      return null;
    }
  };

  const restore = async (): Promise<boolean> => {
    const kept = await stored();
    if (!kept) {
      begin();
      return false;
    }
    anythingKept = true;
    hasFitted = true;
    apply(store, visitEnded());
    const before = store.getState();
    await readers.manifest();
    const revival = reviving(kept, knownAs);
    await revival.readPage(inSight);
    const { leader, song, takes } = store.getState();
    // Files that the visitor was quicker with stay.
    const overtaken = leader !== before.leader || song !== before.song || takes.length > 0;
    if (overtaken) apply(store, takesBroughtBack(revival.content(store.getState()).takes ?? []));
    else apply(store, broughtBack(revival.content(store.getState())));
    begin();
    void revival.readRest(aside).then(() => {
      apply(store, takesBroughtBack(revival.content(store.getState()).takes ?? []));
      for (const loss of revival.losses()) apply(store, remarked(loss));
    });
    return true;
  };

  const openProject = async (file: File): Promise<boolean> => {
    apply(store, dismissed());
    try {
      const kept = readProject(new Uint8Array(await file.arrayBuffer()));
      await readers.manifest();
      const before = store.getState();
      const revival = reviving(kept);
      await revival.readPage(inSight);
      await revival.readRest(aside);
      const now = store.getState();
      // A file that the visitor chose meanwhile is the newer wish.
      if (now.leader !== before.leader || now.song !== before.song) return false;
      const content = revival.content(now);
      if (kept.page.leader !== null && !content.leader) return false;
      apply(store, projectOpened(content));
      apply(store, announced(openedWords(store.getState())));
      for (const loss of revival.losses()) apply(store, remarked(loss));
      return true;
    } catch (error) {
      apply(store, told(projectProblem(error, file.name, 'any-file')));
      return false;
    }
  };

  return {
    restore,
    openProject,
    project: async () => {
      const state = store.getState();
      try {
        return { name: projectName(state), bytes: await writeProject(keep(state)) };
      } catch {
        const error = new AppError(
          'too-large',
          'The project could not be written.',
          'Delete some takes, or close other tabs, and save again.',
        );
        apply(store, told(projectProblem(error, projectName(state), 'none')));
        return null;
      }
    },
    startAfresh: () => {
      apply(store, startedAfresh(store.getState().manifest, rolledSeed()));
    },
    dispose: () => {
      clearTimeout(timer);
      unsubscribe();
      globalThis.document?.removeEventListener('visibilitychange', onHide);
    },
  };
}

/** The parts of the state that are kept; while they are the same, there is nothing to write. */
function keptParts(state: AppState): readonly unknown[] {
  const { takes, reaction, other, letter, compare, footLock, song } = state;
  return [
    takes,
    reaction,
    other,
    letter,
    compare,
    footLock,
    song,
    ...Object.values<unknown>({ ...presentInputs(state) }),
  ];
}

/** `descarga_lead-0412.reactdance`. */
function projectName({ song, leader }: AppState): string {
  const parts = [song && slug(song.name, 'song'), leader && slug(leader.name, 'leader')];
  return `${parts.filter(Boolean).join('_') || 'project'}.reactdance`;
}

/** `Opened: descarga.mp3, lead_0412.bvh, 3 takes`. */
export function openedWords({ song, leader, takes }: Pick<AppState, 'song' | 'leader' | 'takes'>): string {
  const count = takes.length === 1 ? '1 take' : `${takes.length || 'no'} takes`;
  return `Opened: ${[song?.name ?? 'no song', leader?.name ?? 'no leader', count].join(', ')}`;
}
