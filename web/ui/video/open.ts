import type { Files, Services } from '../store/services';
import type { Store } from '../store/store';
import { apply } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { fileProblem } from '../store/problems';
import type { VideoTrack } from './video-lane';
import type { VideoLeader } from './video-leader';

/** Makes a leader of a video; everything that needs is loaded with the first one. */
export interface VideoFeature {
  /** Reads a video file. */
  readonly open: (file: File) => Promise<void>;
  /** Ends the reading of a video, since a newer leader has been asked for. */
  readonly cancel: () => void;
  /** Records with the webcam and reads that. */
  readonly record: () => Promise<void>;
}

/**
 * @param host the stage, over which the video is shown
 * @param files where the motion and the sound go
 * @param track the video that is open, for the timeline and the exported video
 */
export function createVideoFeature(
  store: Store,
  files: () => Pick<Files, 'openLeader' | 'openSong'>,
  host: () => HTMLElement,
  playback: Pick<Services, 'seek' | 'togglePlay'>,
  track: VideoTrack,
): VideoFeature {
  let leader: VideoLeader | null = null;
  const load = async (): Promise<VideoLeader> => {
    if (leader) return leader;
    const module = await import('./video-leader');
    return (leader ??= new module.VideoLeader(store, files(), host(), track));
  };
  return {
    open: async (file) => {
      try {
        await (await load()).open(file, false);
      } catch (error) {
        apply(store, problemShown(fileProblem(error, 'leader', file.name)));
      }
    },
    cancel: () => leader?.cancel(),
    record: async () => {
      try {
        const [videoLeader, { recordCamera }] = await Promise.all([load(), import('./camera-dialog')]);
        const file = await recordCamera(host(), store, playback);
        if (file) await videoLeader.open(file, store.getState().song !== null);
      } catch (error) {
        apply(store, problemShown(fileProblem(error, 'leader', 'The camera')));
      }
    },
  };
}
