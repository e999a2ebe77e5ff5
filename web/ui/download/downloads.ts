import type { PictureSize } from '../../common/picture';
import {
  captioned,
  type MotionFormat,
  planVideo,
  secondsLeft,
  type VideoPlan,
  videoPixels,
  writeMotion,
  writeVideo,
} from '../../export/client';
import { chosenDance, chosenFrames, chosenRole, fileNameParts } from './dance';
import {
  downloadChosen,
  videoProgressChanged,
  savedChanged,
  writingChanged,
} from '../store/actions/download';
import { motionFileName, pictureFileName, videoFileName } from './file-name';
import { isAbort, savingProblem } from '../store/problems';
import { canShare, saveFile, shareFile } from './save-and-share';
import { songStart } from '../store/song-shift';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { type OpenStage, pictureOf } from './video-stage';
import { problemShown } from '../store/actions/notices';
import { playbackSet } from '../store/actions/view';
import { AppError } from '../../common/error';

/** What the downloads need of the rest of the page. */
interface DownloadTools {
  /** Null without a stage. */
  readonly openVideoStage: OpenStage | null;
  /** The same with the leader's video in the other half of the picture; null without such a video. */
  readonly openBesideVideo: () => OpenStage | null;
  readonly stageSize: () => PictureSize | null;
}

type Downloads = Pick<
  Services,
  'saveMotion' | 'planVideo' | 'saveVideo' | 'cancelVideo' | 'savePicture' | 'shareSaved' | 'videoSize'
>;

type SaveFile = typeof saveFile;

/** Least time between two updates of a video's progress: without a graphics card, drawing the page is slow. */
const PROGRESS_INTERVAL_MS = 400;
/** Size of a video as on stage where there is no stage. */
const FALLBACK_SIZE: PictureSize = { width: 1280, height: 720 };

/** Writes motions, videos and pictures to files. A failure is reported as a problem and changes nothing else. */
export function createDownloads(store: Store, tools: DownloadTools): Downloads {
  let lastSaved: File | null = null;
  const save: SaveFile = (file, name) => {
    saveFile(file, name);
    lastSaved = new File([file], name, { type: file.type });
    apply(store, savedChanged({ name, bytes: file.size, shareable: canShare(lastSaved) }));
  };
  return {
    videoSize: () => (tools.openVideoStage ? videoSize(store, tools) : null),
    planVideo: () => planFor(store, tools),
    saveMotion: (format) => void saveMotion(store, format, save),
    ...createVideoJob(store, tools, save),
    savePicture: () => void savePicture(store, tools, save),
    shareSaved: () => {
      if (!lastSaved) return;
      shareFile(lastSaved).catch((error: unknown) => {
        if (!isAbort(error)) apply(store, problemShown(savingProblem(error)));
      });
    },
  };
}

async function saveMotion(store: Store, format: MotionFormat, save: SaveFile): Promise<void> {
  const state = store.getState();
  const who = chosenRole(state);
  const named = fileNameParts(state);
  const dance = chosenDance(state);
  if (!named || !dance || state.writing) return;
  apply(store, downloadChosen({ format }));
  apply(store, writingChanged(format));
  try {
    const nameOf = (role: typeof who): string => motionFileName(named, role, format);
    save(await writeMotion(format, dance, state.theme, nameOf), nameOf(who));
  } catch (error) {
    apply(store, problemShown(savingProblem(error)));
  } finally {
    apply(store, writingChanged(null));
  }
}

/** Saves the moment that the stage shows as a PNG, in the size and with the credit of a video. */
async function savePicture(store: Store, tools: DownloadTools, save: SaveFile): Promise<void> {
  const state = store.getState();
  const named = fileNameParts(state);
  const open = stageOf(state, tools);
  if (!named || !open || state.writing) return;
  apply(store, writingChanged('png'));
  try {
    const png = await pictureOf(open, videoSize(store, tools), state);
    save(png, pictureFileName(named, state.download.size, state.playback.time));
  } catch (error) {
    apply(store, problemShown(savingProblem(error)));
  } finally {
    apply(store, writingChanged(null));
  }
}

/** How the stage of a video or a picture is opened: with the leader's video beside the dance if that is chosen. */
function stageOf({ download }: AppState, tools: DownloadTools): OpenStage | null {
  return (download.beside ? tools.openBesideVideo() : null) ?? tools.openVideoStage;
}

/** Starts and cancels the one video that may be written at a time. */
function createVideoJob(
  store: Store,
  tools: DownloadTools,
  save: SaveFile,
): Pick<Downloads, 'saveVideo' | 'cancelVideo'> {
  let running: AbortController | null = null;
  return {
    saveVideo: () => {
      if (running) return;
      const controller = new AbortController();
      running = controller;
      const end = (): void => {
        if (running !== controller) return;
        running = null;
        apply(store, videoProgressChanged(null));
      };
      // A cancelled video has ended for the visitor at once; its resources are freed later.
      controller.signal.addEventListener('abort', end, { once: true });
      apply(store, savedChanged(null));
      // Two stages that draw at once would slow each other down.
      apply(store, playbackSet({ playing: false }));
      writeDance(store, tools, save, controller.signal).then(end, (error: unknown) => {
        end();
        if (!controller.signal.aborted && !isAbort(error)) apply(store, problemShown(savingProblem(error)));
      });
    },
    cancelVideo: () => {
      running?.abort();
    },
  };
}

/** Writes the video of the dance on the stage or its loop, one video frame for each frame of the motion, and saves it. */
async function writeDance(
  store: Store,
  tools: DownloadTools,
  save: SaveFile,
  signal: AbortSignal,
): Promise<void> {
  const state = store.getState();
  const named = fileNameParts(state);
  const open = stageOf(state, tools);
  if (!named || !open) return;
  const size = videoSize(store, tools);
  const sound = soundOf(store);
  const { clip } = named.inputs.leader.file;
  const { fps } = clip;
  const { from, to } = chosenFrames(state, clip);
  const frames = to - from;
  apply(store, videoProgressChanged({ frame: 0, frames, secondsLeft: null }));
  const plan = await planVideo(size, sound !== null);
  signal.throwIfAborted();
  if (!plan) throw unsupported();
  const stage = await open(size, from / fps);
  try {
    const { theme, download } = state;
    const picture = captioned(stage.canvas, download, theme);
    const draw = async (frame: number): Promise<void> => {
      await stage.drawAt((from + frame) / fps);
      picture.draw(frame / fps);
    };
    const file = await writeVideo(
      {
        fps,
        frames,
        canvas: picture.canvas,
        draw,
        sound: sound && { file: sound, start: songStart(named.inputs) - from / fps },
      },
      plan,
      { signal, onProgress: videoProgress(store, frames, signal) },
    );
    save(file, videoFileName(named, state.download.size, plan.container));
  } finally {
    stage.dispose();
  }
}

/** Puts the progress of a video and the time it will still take into the state. */
function videoProgress(store: Store, frames: number, signal: AbortSignal): (frame: number) => void {
  const begin = performance.now();
  let updated = begin;
  return (frame) => {
    const now = performance.now();
    if (signal.aborted || now - updated < PROGRESS_INTERVAL_MS) return;
    updated = now;
    apply(
      store,
      videoProgressChanged({ frame, frames, secondsLeft: secondsLeft((now - begin) / 1000, frame, frames) }),
    );
  };
}

function videoSize(store: Store, { stageSize }: DownloadTools): PictureSize {
  return videoPixels(store.getState().download.size, stageSize() ?? FALLBACK_SIZE);
}

/** The file of the song that the reaction was made to, if any. */
function soundOf(store: Store): Blob | null {
  return store.getState().reaction?.inputs.song?.data.sound ?? null;
}

/** How the browser would write the video; null when it can't. */
async function planFor(store: Store, tools: DownloadTools): Promise<VideoPlan | null> {
  return tools.openVideoStage ? planVideo(videoSize(store, tools), soundOf(store) !== null) : null;
}

function unsupported(): AppError {
  return new AppError(
    'video-unsupported',
    'This browser cannot write videos.',
    'Open the page in a current Chrome, Edge, Firefox or Safari. Motions can be saved here all the same.',
  );
}
