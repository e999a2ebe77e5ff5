import {
  ExportError,
  planVideo,
  secondsLeft,
  type VideoPlan,
  videoPixels,
  writeMotion,
  writeVideo,
} from '../../export/client';
import { danceOf, namedAfter } from './dance';
import {
  downloadChosen,
  videoProgressChanged,
  savedChanged,
  writingChanged,
} from '../store/actions/download';
import { motionFileName, videoFileName } from './file-name';
import { isAbort, savingProblem } from '../store/problems';
import { songStart } from '../store/song-shift';
import type { Services } from '../store/services';
import { apply, type Store } from '../store/store';
import { problemShown } from '../store/actions/notices';
import { playbackSet } from '../store/actions/view';

interface Pixels {
  readonly width: number;
  readonly height: number;
}

/** The dance on the stage at the moment it was asked for, drawn picture by picture. */
export interface Camera {
  readonly canvas: HTMLCanvasElement;
  /** Draws the moment `seconds`; moments ascend. */
  readonly shoot: (seconds: number) => void;
  readonly dispose: () => void;
}

/** What the downloads need of the rest of the page. */
export interface DownloadTools {
  /** Sets up a camera beside the stage, framed alike; null without a stage. */
  readonly camera: ((size: Pixels) => Promise<Camera>) | null;
  readonly stageSize: () => Pixels | null;
  /** Hands a file to the browser's downloads. */
  readonly save: (file: Blob, name: string) => void;
  /** Passes a file on to another app; `can` says whether the system takes it. */
  readonly share: { readonly can: (file: File) => boolean; readonly pass: (file: File) => Promise<void> };
}

export type Downloads = Pick<
  Services,
  'saveMotion' | 'planVideo' | 'saveVideo' | 'cancelVideo' | 'shareSaved' | 'stageSize'
>;

/** The page is told of a video's progress at most this often, milliseconds: without a graphics card, showing it costs. */
const BETWEEN_REPORTS = 400;

/** Writing files to take home. A failure becomes a sentence and changes nothing else. */
export function createDownloads(store: Store, { camera, stageSize, save, share }: DownloadTools): Downloads {
  let filming: AbortController | null = null;
  let last: File | null = null;

  const handOver = (file: Blob, name: string): void => {
    save(file, name);
    last = new File([file], name, { type: file.type });
    apply(store, savedChanged({ name, bytes: file.size, shareable: share.can(last) }));
  };

  const pixels = (): Pixels => {
    const { size } = store.getState().download;
    return videoPixels(size, stageSize() ?? { width: 1280, height: 720 });
  };
  const song = (): Blob | null => store.getState().reaction?.inputs.song?.data.sound ?? null;
  const planned = async (): Promise<VideoPlan | null> =>
    camera ? planVideo(pixels(), song() !== null) : null;

  async function film(signal: AbortSignal): Promise<void> {
    const state = store.getState();
    const named = namedAfter(state);
    if (!named || !camera) return;
    const size = pixels();
    const sound = song();
    const { fps, frames } = named.inputs.leader.file.clip; // a picture for each frame of the motion
    apply(store, videoProgressChanged({ frame: 0, frames, secondsLeft: null }));
    const plan = await planVideo(size, sound !== null);
    signal.throwIfAborted();
    if (!plan) throw unsupported();
    const shot = await camera(size);
    try {
      const begin = performance.now();
      let shown = begin;
      const file = await writeVideo(
        {
          ...size,
          fps,
          frames,
          canvas: shot.canvas,
          draw: (frame) => {
            shot.shoot(frame / fps);
          },
          sound: sound && { file: sound, start: songStart(named.inputs) },
        },
        plan,
        {
          signal,
          onProgress: ({ frame }) => {
            const now = performance.now();
            if (signal.aborted || now - shown < BETWEEN_REPORTS) return;
            shown = now;
            const left = secondsLeft((now - begin) / 1000, frame, frames);
            apply(store, videoProgressChanged({ frame, frames, secondsLeft: left }));
          },
        },
      );
      handOver(file, videoFileName(named, state.download.size, plan.container));
    } finally {
      shot.dispose();
    }
  }

  return {
    stageSize,
    planVideo: planned,
    saveMotion: (format) => {
      const state = store.getState();
      const { who } = state.download;
      const named = namedAfter(state);
      const dance = danceOf(state, who);
      if (!named || !dance || state.writing) return;
      apply(store, downloadChosen({ format }));
      apply(store, writingChanged(format));
      writeMotion(format, dance, state.theme, (role) => motionFileName(named, role, format))
        .then((file) => {
          handOver(file, motionFileName(named, who, format));
        })
        .catch((error: unknown) => {
          apply(store, problemShown(savingProblem(error)));
        })
        .finally(() => {
          apply(store, writingChanged(null));
        });
    },
    saveVideo: () => {
      if (filming) return;
      const controller = new AbortController();
      filming = controller;
      const over = (): void => {
        if (filming !== controller) return;
        filming = null;
        apply(store, videoProgressChanged(null));
      };
      // Whoever cancels is at once where they were; the rest is tidied up behind.
      controller.signal.addEventListener('abort', over, { once: true });
      apply(store, savedChanged(null));
      // Two stages that draw at once would each wait for the other.
      apply(store, playbackSet({ playing: false }));
      film(controller.signal)
        .catch((error: unknown) => {
          if (!controller.signal.aborted && !isAbort(error)) apply(store, problemShown(savingProblem(error)));
        })
        .finally(over);
    },
    cancelVideo: () => {
      filming?.abort();
    },
    shareSaved: () => {
      if (!last) return;
      share.pass(last).catch((error: unknown) => {
        if (!isAbort(error)) apply(store, problemShown(savingProblem(error)));
      });
    },
  };
}

function unsupported(): ExportError {
  return new ExportError(
    'video-unsupported',
    'This browser cannot write videos.',
    'Open the page in a current Chrome, Edge, Firefox or Safari. Motions can be saved here all the same.',
  );
}
