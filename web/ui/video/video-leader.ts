import {
  createVideoReader,
  DEFAULT_FOCAL,
  type Observations,
  type Point,
  type ReadReport,
  type VideoMotion,
  type VideoReader,
  type WorldOptions,
} from '../../video/client';
import { AppError } from '../../common/error';
import { readLeader } from '../../motion/client';
import { FPS } from '../../motion/skeleton/clip';
import { problemShown } from '../store/actions/notices';
import { shiftSet } from '../store/actions/timeline';
import { stageCovered } from '../store/actions/view';
import { firstVisitEnded } from '../store/actions/files';
import { fileProblem, isAbort } from '../store/problems';
import type { LeaderSource } from '../store/reaction';
import type { Files } from '../store/services';
import { apply, watch, watchAll, type Store } from '../store/store';
import { combineDisposers } from '../widgets/dom';
import type { Thumbnail, VideoTrack } from './video-lane';
import { PartPlayer } from './part-player';
import { VideoPanel } from './video-panel';

/** Height of a dancer until it is told, metres. */
const DEFAULT_HEIGHT = 1.7;

/** A video that is open. */
interface Session {
  readonly file: File;
  readonly reader: VideoReader;
  readonly panel: VideoPanel;
  readonly ended: AbortController;
  /** The video whose dancer is the leader until this one has been read; it is shown again if that fails. */
  before: Session | null;
  /** Whether the song starts with the video: it played while that was recorded, or is its sound. */
  songOfVideo: boolean;
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
    private readonly files: Pick<Files, 'openLeader' | 'openSong'>,
    private readonly host: HTMLElement,
    private readonly track: VideoTrack,
  ) {
    this.#part = new PartPlayer(store);
  }

  /** @param songOfVideo whether the page's song played while the video was recorded */
  async open(file: File, songOfVideo: boolean): Promise<void> {
    const { store } = this;
    const before = this.#putAside();
    apply(store, firstVisitEnded());
    const ended = new AbortController();
    const session: Session = {
      file,
      reader: createVideoReader(),
      ended,
      before,
      songOfVideo,
      observations: null,
      options: { height: DEFAULT_HEIGHT, focal: DEFAULT_FOCAL, trim: null },
      motion: null,
      thumbnails: [],
      panel: new VideoPanel(this.host, file, {
        close: () => {
          this.#end(session);
        },
        cancel: () => {
          this.#cancelReading(session);
        },
        pick: (point) => void this.#read(session, point),
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

  async #read(session: Session, pick: Point | null): Promise<void> {
    const { file, reader, panel, ended } = session;
    this.#reading?.abort();
    const reading = new AbortController();
    this.#reading = reading;
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
        } else panel.showReport(report);
      };
      const observations = await reader.read(file, pick, session.options, signal, onReport);
      session.observations = observations;
      session.thumbnails = thumbnails;
      await this.#solve(session, session.options);
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      this.#endReading(session);
      if (error instanceof AppError && error.code === 'sound-only')
        await this.files.openSong(file, file.name, null);
      else apply(this.store, problemShown(fileProblem(error, 'leader', file.name)));
    } finally {
      if (this.#reading === reading) this.#reading = null;
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
  async #solve(session: Session, options: WorldOptions): Promise<void> {
    const { observations, reader, file, panel, ended, motion: before } = session;
    session.options = options;
    if (!observations) return;
    try {
      const motion = await reader.solve(observations, options, ended.signal);
      // A newer choice is being computed.
      if (session.options !== options) return;
      session.motion = motion;
      panel.showMotion(observations, motion);
      this.#showLane(session);
      const { shift } = this.store.getState();
      await this.files.openLeader(sourceOf(file, motion.bvh));
      if (session.before) this.#end(session.before);
      const moved = before ? shift + (before.start - motion.start) * FPS : -motion.start * FPS;
      if (before ? shift !== 0 || session.songOfVideo : session.songOfVideo)
        apply(this.store, shiftSet(moved));
    } catch (error) {
      if (ended.signal.aborted || isAbort(error)) return;
      apply(this.store, problemShown(fileProblem(error, 'leader', file.name)));
    } finally {
      this.#part.end();
    }
  }

  /** The video on the timeline, as far as it is read. */
  #showLane({ file, motion, ...session }: Session, thumbnails = session.thumbnails): void {
    const { start = 0, confidence = new Float32Array() } = motion ?? {};
    this.track.set({ name: file.name, file, start, confidence, thumbnails, fps: FPS });
  }

  async #useSound(session: Session): Promise<void> {
    const song = await this.files.openSong(session.file, session.file.name, null);
    if (!song) return;
    session.songOfVideo = true;
    session.panel.showSoundUsed();
    if (session.motion) apply(this.store, shiftSet(-session.motion.start * FPS));
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
        ({ leader }) => leader,
        (leader) => {
          const own = leader?.name === session.file.name && leader.label === null;
          // What comes while it is read was asked for earlier, as the demo: newer files call `cancel`.
          if (session.motion && !own) this.#end(session);
        },
      ),
    );
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
    if (!before || !this.#showAgain(before)) this.track.set(null);
  }

  #cancelReading(session: Session): void {
    this.#reading?.abort();
    this.#endReading(session);
  }

  /** After a reading that brought nothing: shows the person who was followed before; the video closes if there is none. */
  #endReading(session: Session): void {
    if (this.#showAgain(session)) this.#part.end();
    else this.#end(session);
  }

  /** Shows what was read of a video before; false where nothing was. */
  #showAgain(session: Session): boolean {
    const { observations, motion, panel } = session;
    if (!observations || !motion) return false;
    panel.showMotion(observations, motion);
    this.#showLane(session);
    return true;
  }
}

/** The dancer of a video, as a leader that is read. */
function sourceOf({ name }: File, bvh: string): LeaderSource {
  const bytes = new TextEncoder().encode(bvh);
  return { name, label: null, files: [{ name: 'leader.bvh', bytes }], options: {} };
}
