import type { Files, Readers } from '../store/services';
import {
  emptyFileProblem,
  fileProblem,
  isAbort,
  otherMotionProblem,
  unknownFileProblem,
} from '../store/problems';
import { HEAD_BYTES, kindOf } from './file-type';
import type { LoadedLeader, LoadedSong, Side } from '../store/state';
import { leaderLoaded, readingSet, songLoaded, visitEnded } from '../store/actions/files';
import { apply, type Change, type Store } from '../store/store';
import { told, dismissed } from '../store/actions/notices';
import { unremembered } from '../store/history';

/**
 * Least time between two changes of a progress line, milliseconds: where the processor draws the picture, each of
 * them takes time from the work.
 */
const BETWEEN_REPORTS = 500;

/**
 * Reading songs and leaders. A newer file of a kind drops the older one that is still being read; a file that
 * fails leaves what was loaded before as it is and becomes a sentence.
 */
export function createFiles(store: Store, readers: Readers): Files {
  const running: Record<Side, AbortController | null> = { song: null, leader: null };

  async function read<T>(
    side: Side,
    name: string,
    work: (signal: AbortSignal, progress: (fraction: number) => void) => Promise<T>,
    done: (value: T) => void,
  ): Promise<T | null> {
    running[side]?.abort();
    const controller = new AbortController();
    running[side] = controller;
    apply(store, readingSet(side, { name, fraction: 0 }));
    let shown = performance.now();
    try {
      const value = await work(controller.signal, (fraction) => {
        // Progress crosses from a worker and may arrive after the result.
        if (running[side] !== controller || performance.now() - shown < BETWEEN_REPORTS) return;
        shown = performance.now();
        apply(store, readingSet(side, { name, fraction }));
      });
      if (controller.signal.aborted) return null;
      running[side] = null;
      done(value);
      return value;
    } catch (error) {
      if (controller.signal.aborted || isAbort(error)) return null;
      running[side] = null;
      apply(store, readingSet(side, null));
      apply(store, told(fileProblem(error, side, name)));
      return null;
    }
  }

  const readSong = (
    blob: Blob,
    name: string,
    label: string | null,
    done: (song: LoadedSong) => void,
  ): Promise<LoadedSong | null> =>
    read(
      'song',
      name,
      async (signal, progress): Promise<LoadedSong> => {
        const { audio } = await readers.manifest();
        const data = await readers.loadSong(blob, audio, {
          signal,
          onProgress: ({ fraction }) => {
            progress(fraction);
          },
        });
        // The bytes themselves: a file of the visitor's disk may have changed by the time it is kept.
        const file = new Blob([await blob.arrayBuffer()], { type: blob.type });
        return { name, label, file, data };
      },
      done,
    );

  const readLeader = (
    text: string,
    name: string,
    label: string | null,
    fps: number | null,
    done: (leader: LoadedLeader) => void,
  ): Promise<LoadedLeader | null> =>
    read(
      'leader',
      name,
      async (signal): Promise<LoadedLeader> => {
        const { file, motion } = await readers.readLeader({ text, fps }, signal);
        return { name, label, text, fps, file, motion };
      },
      done,
    );

  /** What comes with a label is the page's own and nothing that a visitor would take back. */
  const put = (change: Change, label: string | null): void => {
    apply(store, label === null ? change : unremembered(change));
  };
  const putLeader = (leader: LoadedLeader): void => {
    put(leaderLoaded(leader), leader.label);
  };
  /** The page's own material never takes the place of what came while it was being read, as by undoing. */
  const late = (side: Side, label: string | null): boolean =>
    label !== null && store.getState()[side] !== null;
  const openSong: Files['openSong'] = (blob, name, label) =>
    readSong(blob, name, label, (song) => {
      if (late('song', label)) apply(store, readingSet('song', null));
      else put(songLoaded(song), label);
    });

  async function openOne(file: File): Promise<void> {
    if (file.size === 0) {
      apply(store, told(emptyFileProblem(file.name)));
      return;
    }
    const head = new Uint8Array(await file.slice(0, HEAD_BYTES).arrayBuffer());
    switch (kindOf(head, file.name, file.type)) {
      case 'song':
        apply(store, visitEnded());
        await openSong(file, file.name, null);
        return;
      case 'leader':
        apply(store, visitEnded());
        await readLeader(await file.text(), file.name, null, null, putLeader);
        return;
      case 'other-motion':
        apply(store, told(otherMotionProblem(file.name)));
        return;
      case 'unknown':
        apply(store, told(unknownFileProblem(file.name)));
    }
  }

  return {
    open: async (files) => {
      apply(store, dismissed());
      await Promise.all(
        files.map(async (file) => {
          try {
            await openOne(file);
          } catch (error) {
            // A folder, or a file that vanished between choosing and reading.
            apply(store, told(fileProblem(error, 'leader', file.name)));
          }
        }),
      );
    },
    openSong,
    openLeader: (text, name, label) =>
      readLeader(text, name, label, null, (leader) => {
        if (late('leader', label)) apply(store, readingSet('leader', null));
        else putLeader(leader);
      }),
    rereadLeader: async (fps) => {
      const { leader } = store.getState();
      return leader ? readLeader(leader.text, leader.name, leader.label, fps, putLeader) : null;
    },
    readSong: (blob, name, label) =>
      readSong(blob, name, label, () => {
        apply(store, readingSet('song', null));
      }),
    readLeader: (text, name, label, fps) =>
      readLeader(text, name, label, fps, () => {
        apply(store, readingSet('leader', null));
      }),
  };
}
