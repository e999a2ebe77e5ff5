import { loadPart } from '../../common/page-part';
import type { Files, Services } from '../store/services';
import { songStart } from '../store/song-shift';
import type { Store } from '../store/store';
import type { VideoTrack } from './video-lane';
import type { VideoLeader } from './video-leader';

/** Makes a leader of a video; everything that needs is loaded with the first one. */
export interface VideoFeature {
  /** Reads a video file. */
  readonly open: (file: File) => Promise<void>;
  /** Ends the reading of a video, since a newer leader has been asked for. */
  readonly cancel: () => void;
  /** Records with the webcam and reads that; does nothing while the camera's dialog is open. */
  readonly record: () => Promise<void>;
}

/**
 * @param host the stage, over which the video is shown
 * @param files where the motion and the sound go
 * @param track the video that is open, for the timeline and the exported video
 */
export function createVideoFeature(
  store: Store,
  files: () => Pick<Files, 'openLeader' | 'openSong' | 'fail'>,
  host: () => HTMLElement,
  playback: Pick<Services, 'seek' | 'togglePlay'>,
  track: VideoTrack,
): VideoFeature {
  let leader: VideoLeader | null = null;
  /** Aborted when a newer leader has been asked for, also while what reads videos is still being loaded. */
  let asked = new AbortController();
  const load = async (): Promise<VideoLeader> => {
    const { VideoLeader } = await loadPart(() => import('./video-leader'));
    return (leader ??= new VideoLeader(store, files(), host(), track));
  };
  const cancel = (): void => {
    asked.abort();
    leader?.cancel();
  };
  const open = async (file: File, songStart: number | null = null): Promise<void> => {
    cancel();
    const { signal } = (asked = new AbortController());
    try {
      const videoLeader = await load();
      if (!signal.aborted) await videoLeader.open(file, songStart);
    } catch (error) {
      if (!signal.aborted) files().fail(error, 'leader', file.name, () => void open(file, songStart));
    }
  };
  /** The camera's dialog is open, or on its way: the browser may ask the visitor first. */
  let filming = false;
  const film = async (): Promise<File | null> => {
    filming = true;
    try {
      const { recordCamera } = await loadPart(() => import('./camera-dialog'));
      return await recordCamera(host(), store, playback);
    } finally {
      filming = false;
    }
  };
  const record = async (): Promise<void> => {
    if (filming) return;
    try {
      const file = await film();
      // The dance is played from its start as the recording begins, and the song at its place in it.
      const state = store.getState();
      if (file) await open(file, state.song ? songStart(state) : null);
    } catch (error) {
      files().fail(error, 'leader', 'The camera', () => void record());
    }
  };
  return { open, cancel, record };
}
