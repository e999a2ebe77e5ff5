import type { FileChoice, Files, FileReaders } from '../store/services';
import { emptyFileProblem, fileProblem, isAbort, unknownFileProblem } from '../store/problems';
import { fileKind, HEAD_BYTES } from './file-type';
import type { LeaderSource, LoadedLeader, LoadedSong } from '../store/reaction';
import type { ImportOptions } from '../../motion/retarget/options';
import { groupCompanions } from '../../motion/import/format';
import type { FileBytes } from '../../motion/import/read';
import type { AppState, InputKind } from '../store/state';
import { leaderLoaded, leaderRefused, readingSet, songLoaded, firstVisitEnded } from '../store/actions/files';
import { apply, type Change, type Store } from '../store/store';
import { problemShown, problemClosed, toastShown } from '../store/actions/notices';
import { ask } from '../store/history/asked';
import { loadingJoined, withoutUndo } from '../store/history/history';

/**
 * Least time between two changes of a progress line: where the processor draws the picture, each of them takes time
 * from the work.
 */
const PROGRESS_INTERVAL_MS = 500;

async function bytesOf(file: File): Promise<FileBytes> {
  return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
}

async function sameBytes(...both: readonly [Blob, Blob]): Promise<boolean> {
  if (both[0].size !== both[1].size) return false;
  const [one, other] = await Promise.all(both.map(async (blob) => new Uint8Array(await blob.arrayBuffer())));
  return one!.every((value, i) => value === other![i]);
}

/** A source that is in memory. */
function given(source: LeaderSource): () => Promise<LeaderSource> {
  return () => Promise.resolve(source);
}

/** What else makes leaders: videos, and the files that ship with the page, which are downloaded first. */
interface OtherLeaders {
  readonly openVideo: (file: File) => Promise<void>;
  /** A newer leader has been asked for: one that is not there yet gives way. */
  readonly cancel: () => void;
}

/** Whether the visitor has put another song or leader on the page while one was read, as by the choice of a take. */
function isOverruled(kind: InputKind, state: AppState, before: AppState): boolean {
  // What the page loads by itself is no step of undo; what has just been read is no longer being read.
  const isStep = state.history !== before.history && state.reading[kind] === before.reading[kind];
  return isStep && state[kind] !== before[kind];
}

/** A song or leader to read, and what to do with it. */
interface Task<T> {
  readonly side: InputKind;
  readonly name: string;
  /** Whether the visitor has asked for it: undo ends its reading. */
  readonly asked: boolean;
  readonly read: (signal: AbortSignal, progress: (fraction: number) => void) => Promise<T>;
  readonly done: (value: T) => void;
  /** Called when it could not be read. */
  readonly refused?: () => void;
}

/**
 * Reads songs and leaders and puts them into the store; videos are handed on. A newer file of a kind cancels the older
 * one that is still being read, as does a song or leader that comes onto the page in another way; a file that fails is
 * reported as a problem and leaves what was loaded before as it is.
 */
export class FileLoader implements Files {
  private readonly running: Record<InputKind, AbortController | null> = { song: null, leader: null };
  /** Reads again what could not be read last. */
  private readonly retry: Partial<Record<InputKind, () => void>> = {};

  constructor(
    private readonly store: Store,
    private readonly readers: FileReaders,
    private readonly otherLeaders: OtherLeaders,
  ) {
    store.subscribe((state, before) => {
      for (const { kind } of state.asked) if (isOverruled(kind, state, before)) this.cancel(kind);
    });
  }

  async open(files: readonly File[], as?: FileChoice): Promise<void> {
    apply(this.store, problemClosed());
    const before = this.store.getState().history.past.at(-1) ?? null;
    await Promise.all(
      groupCompanions(files).map(async ([file, ...companions]) => {
        if (!file) return;
        try {
          await this.openOne(file, companions, as);
        } catch (error) {
          // A folder, or a file that vanished between choosing and reading.
          apply(this.store, problemShown(fileProblem(error, 'leader', file.name)));
        }
      }),
    );
    apply(this.store, loadingJoined(before));
  }

  openSong(blob: Blob, name: string, label: string | null): Promise<LoadedSong | null> {
    const done = (song: LoadedSong): void => {
      if (this.isSuperseded('song', label)) this.endReading('song');
      else this.put(songLoaded(song), label);
    };
    return this.runSong({ name, asked: label === null, done }, blob, label);
  }

  openLeader(source: LeaderSource): Promise<LoadedLeader | null> {
    const done = (leader: LoadedLeader): void => {
      if (this.isSuperseded('leader', source.label)) this.endReading('leader');
      else this.putLeader(leader);
    };
    return this.runLeader({ name: source.name, asked: false, done }, given(source));
  }

  rereadLeader({ name, label, files }: LeaderSource, options: ImportOptions): Promise<LoadedLeader | null> {
    this.otherLeaders.cancel();
    // A step of undo also where the leader is the page's own: the visitor has changed it.
    const done = (leader: LoadedLeader): void => {
      apply(this.store, leaderLoaded(leader));
    };
    return this.runLeader({ name, asked: true, done }, given({ name, label, files, options }));
  }

  /** Reads the file again whose reading failed last. */
  readonly readAgain = (kind: InputKind): void => {
    this.retry[kind]?.();
  };

  fail(error: unknown, side: InputKind, name: string, again: () => void): void {
    this.retry[side] = again;
    apply(this.store, problemShown(fileProblem(error, side, name)));
  }

  cancel(side: InputKind): void {
    if (side === 'leader') this.otherLeaders.cancel();
    apply(this.store, ({ asked }) => ({ asked: asked.filter(({ kind }) => kind !== side) }));
    if (!this.running[side]) return;
    this.running[side].abort();
    this.running[side] = null;
    this.endReading(side);
  }

  readSong(blob: Blob, name: string, label: string | null, after: Promise<void>): Promise<LoadedSong | null> {
    const done = (): void => {
      this.endReading('song');
    };
    return this.runSong({ name, asked: false, done }, blob, label, after);
  }

  readLeader(source: LeaderSource): Promise<LoadedLeader | null> {
    const done = (): void => {
      this.endReading('leader');
    };
    return this.runLeader({ name: source.name, asked: false, done }, given(source));
  }

  /** @param companions files that belong to this one, as the ASF skeleton of an AMC */
  private async openOne(file: File, companions: readonly File[], as?: FileChoice): Promise<void> {
    if (file.size === 0) {
      apply(this.store, problemShown(emptyFileProblem(file.name)));
      return;
    }
    const head = new Uint8Array(await file.slice(0, HEAD_BYTES).arrayBuffer());
    const kind = fileKind(head, file.name, file.type);
    switch (kind === 'video' && as === 'song' ? 'song' : kind) {
      case 'song':
        apply(this.store, firstVisitEnded());
        await this.openChosenSong(file);
        return;
      case 'leader':
        await this.openLeaderFiles([file, ...companions]);
        return;
      case 'video':
        this.otherLeaders.cancel();
        // What the page reads by itself is shown until the video is read.
        if (this.store.getState().asked.some(({ kind }) => kind === 'leader')) this.cancel('leader');
        await this.otherLeaders.openVideo(file);
        return;
      case 'picture':
      case 'unknown':
        apply(this.store, problemShown(unknownFileProblem(file.name)));
    }
  }

  /** The visitor's song on the page stays when it is chosen again: the dance to it is there. */
  private async openChosenSong(file: File): Promise<void> {
    const { song } = this.store.getState();
    const sameName = song?.label === null && song.name === file.name;
    if (!sameName || !(await sameBytes(song.file, file))) {
      await this.openSong(file, file.name, null);
      return;
    }
    this.cancel('song');
    apply(this.store, toastShown(`${file.name} is already on the page.`));
  }

  /** The first visit ends when the reading begins, so that nothing found of an earlier one cannot begin it again. */
  private async openLeaderFiles(parts: readonly File[]): Promise<void> {
    apply(this.store, firstVisitEnded());
    this.otherLeaders.cancel();
    const { name } = parts[0]!;
    // Read as a part of the task: a newer file is not to wait for the bytes of a large one, nor to be replaced by it.
    const source = async (): Promise<LeaderSource> => {
      const files = await Promise.all(parts.map(bytesOf));
      return { name, label: null, files, options: {} };
    };
    await this.runLeader({ name, asked: true, done: this.putLeader }, source);
  }

  private runSong(
    task: Pick<Task<LoadedSong>, 'name' | 'asked' | 'done'>,
    blob: Blob,
    label: string | null,
    after = Promise.resolve(),
  ): Promise<LoadedSong | null> {
    const read = async (signal: AbortSignal, onProgress: (fraction: number) => void): Promise<LoadedSong> => {
      const { audio } = await this.readers.manifest();
      await after;
      const data = await this.readers.loadSong(blob, audio, { signal, onProgress });
      // The bytes themselves: a file on the visitor's disk may have changed by the time it is saved.
      const file = new Blob([await blob.arrayBuffer()], { type: blob.type });
      return { name: task.name, label, file, data };
    };
    return this.run({ side: 'song', read, ...task });
  }

  /** @param source the leader's bytes and options, asked for when the reading begins */
  private runLeader(
    task: Pick<Task<LoadedLeader>, 'name' | 'asked' | 'done'>,
    source: () => Promise<LeaderSource>,
  ): Promise<LoadedLeader | null> {
    let known: LeaderSource | null = null;
    const read = async (signal: AbortSignal): Promise<LoadedLeader> => {
      known = await source();
      signal.throwIfAborted();
      const { files, options } = known;
      const { file, motion } = await this.readers.readLeader({ files, options }, signal);
      return { ...known, file, motion };
    };
    const refused = (): void => {
      if (known) apply(this.store, leaderRefused(known));
    };
    return this.run({ side: 'leader', read, refused, ...task });
  }

  /** Runs a task with its progress in the store; null when it failed or a newer one cancelled it. */
  private async run<T>(task: Task<T>): Promise<T | null> {
    const { store, running } = this;
    const { side, name, asked, read, done, refused } = task;
    delete this.retry[side];
    running[side]?.abort();
    const controller = new AbortController();
    running[side] = controller;
    const endAsked = asked ? ask(store, side) : () => undefined;
    apply(store, readingSet(side, { name, fraction: 0 }));
    let reported = performance.now();
    try {
      const value = await read(controller.signal, (fraction) => {
        // Progress crosses from a worker and may arrive after the result.
        if (running[side] !== controller || performance.now() - reported < PROGRESS_INTERVAL_MS) return;
        reported = performance.now();
        apply(store, readingSet(side, { name, fraction }));
      });
      if (controller.signal.aborted) return null;
      running[side] = null;
      done(value);
      return value;
    } catch (error) {
      if (controller.signal.aborted || isAbort(error)) return null;
      running[side] = null;
      this.endReading(side);
      refused?.();
      this.fail(error, side, name, () => void this.run(task));
      return null;
    } finally {
      endAsked();
    }
  }

  /** A file with a label is the page's own: loading it is not a step to undo. */
  private put(change: Change, label: string | null): void {
    apply(this.store, label === null ? change : withoutUndo(change));
  }

  private readonly putLeader = (leader: LoadedLeader): void => {
    this.put(leaderLoaded(leader), leader.label);
  };

  /** Whether a file of the page's own is no longer wanted, because another one has been loaded while it was read. */
  private isSuperseded(side: InputKind, label: string | null): boolean {
    return label !== null && this.store.getState()[side] !== null;
  }

  private endReading(side: InputKind): void {
    apply(this.store, readingSet(side, null));
  }
}
