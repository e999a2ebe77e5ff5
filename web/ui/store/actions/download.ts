import type { DownloadChoice, VideoProgress, AppState } from '../state';
import type { Change } from '../store';

/** Chooses in the download menu; what is not named stays. */
export function downloadChosen(choice: Partial<DownloadChoice>): Change {
  return ({ download }) => ({ download: { ...download, ...choice } });
}

export function writingChanged(writing: AppState['writing']): Change {
  return () => ({ writing });
}

export function videoProgressChanged(videoProgress: VideoProgress | null): Change {
  return () => ({ videoProgress });
}

/** A file has gone to the browser's downloads; null forgets it. */
export function savedChanged(saved: AppState['saved']): Change {
  return () => ({ saved });
}
