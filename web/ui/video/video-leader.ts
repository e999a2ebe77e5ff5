import {
  createVideoReader,
  DEFAULT_FOCAL,
  type Observations,
  type PersonPick,
  type ReadReport,
  type VideoMotion,
  type VideoReader,
  type WorldOptions,
} from '../../video/client';
import { AppError } from '../../common/error';
import { readLeader } from '../../motion/client';
import { FPS } from '../../motion/skeleton/clip';
import { shiftSet } from '../store/actions/timeline';
import { stageCovered } from '../store/actions/view';
import { firstVisitEnded } from '../store/actions/files';
import { ask } from '../store/history/asked';
import { shiftJoined } from '../store/history/history';
import { isAbort } from '../store/problems';
import type { LeaderSource, LoadedSong } from '../store/reaction';
import type { Files } from '../store/services';
import { apply, watch, watchAll, type Store } from '../store/store';
import { combineDisposers } from '../widgets/dom';
import type { Thumbnail, VideoTrack } from './video-lane';
import { PartPlayer } from './part-player';
import { VideoPanel } from './video-panel';

/** Height of a dancer until it is told, metres. */
const DEFAULT_HEIGHT = 1.7;

/** What a leader was made of. */
interface Made {
  readonly observations: Observations;
  readonly options: WorldOptions;
  readonly motion: VideoMotion;
}

/** A video that is open. */
interface Session {
  readonly file: File;
  readonly reader: VideoReader;
  readonly panel: VideoPanel;
  readonly ended: AbortController;
  /** Ends the search for people in the picture of a moment. */
  looking: AbortController;
  /** The leaders that were made of it, by their files: another video may have the same name. */
  readonly made: Map<LeaderSource['files'], Made>;
  /** The video whose dancer is the leader until this one has been read; it is shown again if that fails. */
  before: Session | null;
  /** When the video's sound begins, seconds of the video; null where it has none. */
  soundStart: number | null;
  /** The same of the page's song; null where that is neither the sound nor played while the video was recorded. */
  songStart: number | null;
  /** The song that was made of the video's sound. */
  sound: LoadedSong | null;
  observations: Observations | null;
  options: WorldOptions;
  motion: VideoMotion | null;
  thumbnails: readonly Thumbnail[];
}

/**
 * Reads a video, makes its dancer the leader, and shows the video in step with the dance. One video at a time; what was
 * loaded before stays until a motion is there.
 */
export class VideoLeader {
  #session: Session | null = null;
  #reading: AbortController | null = null;
  readonly #part: PartPlayer;

  constructor(
    private readonly store: Store,
    private readonly files: Pick<Files, 'openLeader' | 'openSong' | 'fail'>,
    private readonly host: HTMLElement,
    private readonly track: VideoTrack,
  ) {
    this.#part = new PartPlayer(store);
  }

  /** @param songStart when the page's song begins in the video, seconds; null where it was not recorded to it */
  async open(file: File, songStart: number | null): Promise<void> {
    const { store } = this;
    const before = this.#putAside();
    apply(store, firstVisitEnded());
    const ended = new AbortController();
    const session: Session = {
      file,
      reader: createVideoReader(),
      ended,
      looking: new AbortController(),
      made: new Map(),
      before,
      soundStart: null,
      sound: null,
      songStart,
      observations: null,
      options: { height: DEFAULT_HEIGHT, focal: DEFAULT_FOCAL, trim: null },
      motion: null,
      thumbnails: [],
      panel: new VideoPanel(this.host, file, {
        close: () => {
          this.#end(session);
        },
        reopen: () => {
          this.#showRead(session);
        },
        isPartShown: () => !store.getState().playback.playing,
        cancel: () => {
          this.#cancelReading(session);
        },
        look: (time) => void this.#look(session, time),
        pick: (person) => void this.#read(session, person),
        change: (options) => void this.#solve(session, { ...session.options, ...options }),
        useSound: () => void this.#useSound(session),
        resized: () => {
          apply(store, stageCovered(this.#session?.panel.right ?? 0));
        },
      }),
    };
    this.#session = session;
    ended.signal.addEventListener('abort', this.#follow(session));
    await this.#read(session, null);
  }

  /** A newer leader has been asked for: a video that is still being read is not to take its place. */
  cancel(): void {
    if (this.#session && this.#reading) this.#cancelReading(this.#session);
  }

  async #read(session: Session, pick: PersonPick | null): Promise<void> {
    const { file, reader, panel, ended } = session;
    this.#reading?.abort();
    const reading = new AbortController();
    this.#reading = reading;
    const endAsked = ask(this.store, 'leader');
    const signal = AbortSignal.any([reading.signal, ended.signal]);
    let part = new AbortController();
    try {
      panel.showReading();
      this.#part.end();
      let thumbnails: readonly Thumbnail[] = [];
      this.#showLane(session, thumbnails);
      const onReport = (report: ReadReport): void => {
        if (report.kind === 'thumbnail') {
          thumbnails = [...thumbnails, report];
          this.#showLane(session, thumbnails);
        } else if (report.kind === 'part') {
          // The newest one is the longest.
          part.abort();
          part = new AbortController();
          void this.#showPart(session, report.motion, AbortSignal.any([signal, part.signal]));
        } else {
          if (report.kind === 'opened') session.soundStart = report.soundStart;
          panel.showReport(report);
        }
      };
      const observations = await reader.read(file, pick, session.options, signal, onReport);
      session.thumbnails = thumbnails;
      await this.#solve(session, session.options, observations, signal);
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      if (error instanceof AppError && error.code === 'sound-only') {
        this.#endReading(session);
        await this.files.openSong(file, file.name, null);
      } else this.#fail(session, error, () => void this.#read(session, pick));
    } finally {
      if (this.#reading === reading) this.#reading = null;
      endAsked();
    }
  }

  /** Shows who could be followed from a moment on, seconds of the video. */
  async #look(session: Session, time: number): Promise<void> {
    session.looking.abort();
    session.looking = new AbortController();
    const signal = AbortSignal.any([session.looking.signal, session.ended.signal]);
    try {
      const people = await session.reader.people(session.file, time, signal);
      if (people) session.panel.showPeople(people);
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      this.files.fail(error, 'leader', session.file.name, () => void this.#look(session, time));
    }
  }

  /** Shows what has been read so far on the stage, unless the reading has ended meanwhile. */
  async #showPart({ file, panel }: Session, { bvh }: VideoMotion, signal: AbortSignal): Promise<void> {
    const source = sourceOf(file, bvh);
    // Not by way of `files`, where it would cancel the reading of another leader.
    const read = await readLeader(source, signal).catch(() => null);
    if (!read || signal.aborted) return;
    this.#part.play({ ...source, ...read });
    panel.showPart(read.motion.frames / read.motion.fps);
  }

  /** Makes the motion with these options and puts it on the page as the leader. */
  async #solve(
    session: Session,
    options: WorldOptions,
    observations = session.observations,
    signal = session.ended.signal,
  ): Promise<void> {
    const { store } = this;
    const { reader, file, motion: before, observations: seenBefore } = session;
    session.options = options;
    if (!observations) return;
    try {
      const motion = await reader.solve(observations, options, signal);
      // A newer choice is being computed.
      if (session.options !== options) return;
      session.observations = observations;
      session.motion = motion;
      this.#showRead(session);
      const { shift } = store.getState();
      const source = sourceOf(file, motion.bvh);
      session.made.set(source.files, { observations, options, motion });
      const leader = await this.files.openLeader(source);
      if (!leader && session.motion === motion) {
        // It could not be read, or was cancelled.
        Object.assign(session, { observations: seenBefore, motion: before });
        this.#endReading(session);
        return;
      }
      if (session.before) this.#end(session.before);
      if (before && (shift !== 0 || session.songStart !== null))
        this.#shiftSong(shift + (before.start - motion.start) * FPS);
      else this.#alignSong(session);
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      this.#fail(session, error, () => void this.#solve(session, options, observations));
    } finally {
      this.#part.end();
    }
  }

  /** Goes back to what was there before and says why; a video that closes by that is opened anew to try again. */
  #fail(session: Session, error: unknown, again: () => void): void {
    const { file, songStart, ended } = session;
    this.#endReading(session);
    this.files.fail(error, 'leader', file.name, () => {
      if (ended.signal.aborted) void this.open(file, songStart);
      else again();
    });
  }

  /** The video on the timeline, as far as it is read. */
  #showLane({ file, motion, ...session }: Session, thumbnails = session.thumbnails): void {
    const { start = 0, confidence = new Float32Array() } = motion ?? {};
    this.track.set({ name: file.name, file, start, confidence, thumbnails, fps: FPS });
  }

  async #useSound(session: Session): Promise<void> {
    const song = await this.files.openSong(session.file, session.file.name, null);
    // Another leader may have been chosen while the song was analysed.
    if (!song || session.ended.signal.aborted) return;
    session.songStart = session.soundStart;
    session.sound = song;
    session.panel.setSoundUsed(true);
    this.#alignSong(session);
  }

  /** Starts a song that belongs to the video at its moment of the dance. */
  #alignSong({ songStart, motion }: Session): void {
    if (songStart !== null && motion) this.#shiftSong((songStart - motion.start) * FPS);
  }

  /** In the step of undo that has just loaded the song or the leader. */
  #shiftSong(frames: number): void {
    apply(this.store, shiftSet(frames));
    apply(this.store, shiftJoined());
  }

  /** Keeps the video in step with the dance; closes it when another leader takes the place of its dancer. */
  #follow(session: Session): () => void {
    const { store } = this;
    return combineDisposers(
      watchAll(
        store,
        ({ playback }) => [playback.time, playback.playing, playback.speed],
        ({ playback }) => {
          if (session.motion) session.panel.showTime(playback, session.motion.start);
        },
      ),
      watch(
        store,
        ({ song }) => song,
        (song) => {
          // Undo may take it away, and bring it back.
          if (session.sound) session.panel.setSoundUsed(song === session.sound);
        },
      ),
      watch(
        store,
        ({ leader }) => leader,
        (leader) => {
          const made = leader && session.made.get(leader.files);
          // What comes while it is read was asked for earlier, as the demo: newer files call `cancel`.
          if (session.motion && !made) this.#end(session);
          else if (made && made.motion !== session.motion) this.#goBackTo(session, made);
        },
      ),
    );
  }

  /** Another of its leaders is on the page again, as by undo. */
  #goBackTo(session: Session, made: Made): void {
    Object.assign(session, made);
    session.panel.showOptions(made.options);
    if (session === this.#session) this.#showRead(session);
  }

  /** Makes room for another video: one that is only being read ends, one whose dancer is the leader waits. */
  #putAside(): Session | null {
    if (this.#session && !this.#session.motion) this.#end(this.#session);
    this.#session?.panel.hide();
    return this.#session;
  }

  #end(session: Session): void {
    session.ended.abort();
    session.reader.dispose();
    session.panel.dispose();
    if (this.#session?.before === session) this.#session.before = null;
    if (this.#session !== session) return;
    this.#part.end();
    const { before } = session;
    this.#session = before;
    if (!before || !this.#showRead(before)) this.track.set(null);
  }

  #cancelReading(session: Session): void {
    this.#reading?.abort();
    this.#endReading(session);
  }

  /** After a reading that brought nothing: shows the person who was followed before; the video closes if there is none. */
  #endReading(session: Session): void {
    if (this.#showRead(session)) this.#part.end();
    else this.#end(session);
  }

  /** Shows what was read of a video; false where nothing was. */
  #showRead(session: Session): boolean {
    const { observations, motion, panel } = session;
    if (!observations || !motion) return false;
    panel.showMotion(observations, motion);
    // The moment that is shown may stay the same, and nothing would move the video there.
    panel.showTime(this.store.getState().playback, motion.start);
    this.#showLane(session);
    return true;
  }
}

/** The dancer of a video, as a leader that is read. */
function sourceOf({ name }: File, bvh: string): LeaderSource {
  const bytes = new TextEncoder().encode(bvh);
  return { name, label: null, files: [{ name: 'leader.bvh', bytes }], options: {} };
}
