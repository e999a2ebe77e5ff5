import { AppError } from '../../common/error';
import type { Services } from '../store/services';
import { toastShown } from '../store/actions/notices';
import { playbackSet } from '../store/actions/view';
import { apply, type Store } from '../store/store';
import { textButton, closeButton } from '../widgets/button';
import { el, rememberFocus, setText } from '../widgets/dom';

/** Seconds between the click and the recording: time to walk to one's place. */
const COUNTDOWN = 5;
/** Longest recording, seconds. */
const MAX_SECONDS = 120;
/** In order of preference; without a type the browser takes one of its own. */
const TYPES = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/mp4'];

/**
 * Records a dancer with the webcam: preview, countdown, at most two minutes. The dance of the page plays from its start
 * meanwhile, with its song, if there is one.
 * @returns the video; null when the visitor closes the dialog
 * @throws {AppError} `camera-refused`; `camera-stopped` where it ends before anything was recorded
 */
export async function recordCamera(
  host: HTMLElement,
  store: Store,
  playback: Pick<Services, 'seek' | 'togglePlay'>,
): Promise<File | null> {
  const stream = await openCamera();
  const video = el('video', { attributes: { playsinline: true, 'aria-label': 'Picture of the camera' } });
  video.muted = true;
  video.srcObject = stream;
  const status = el('p', {
    class: 'status',
    text: 'Stand so that your whole body is in the picture, with some floor below the feet.',
  });
  // Without the clock, which changes every second.
  const spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  const cancelled = new AbortController();
  const done = new AbortController();
  let begin: () => void = () => undefined;
  const started = new Promise<void>((resolve) => (begin = resolve));
  const start = textButton('btn primary', 'Record', () => {
    // Not a button, which another Enter would press.
    dialog.focus();
    start.hidden = true;
    begin();
  });
  const stop = textButton('btn primary', 'Stop', () => {
    done.abort();
  });
  stop.hidden = true;
  const close = (): void => {
    cancelled.abort();
    begin();
  };
  const closing = closeButton(close);
  const dialog = el(
    'section',
    {
      class: 'float video-panel camera',
      attributes: { role: 'dialog', 'aria-label': 'Record with the camera', tabindex: -1 },
    },
    el('div', { class: 'head' }, el('h2', { text: 'Record a leader' }), closing),
    el('div', { class: 'frame' }, video),
    status,
    spoken,
    el('div', { class: 'reading' }, start, stop),
  );
  const giveBackFocus = rememberFocus();
  host.append(dialog);
  start.focus();
  // Before the keys of the page, which would cancel something behind the dialog, but after what is in front of it.
  const onKey = (event: KeyboardEvent): void => {
    const { problem, given, openPanel } = store.getState();
    if (event.key !== 'Escape' || problem || given || openPanel) return;
    if (document.querySelector(':popover-open') || event.target instanceof HTMLInputElement) return;
    event.stopPropagation();
    close();
  };
  window.addEventListener('keydown', onKey, { capture: true });
  try {
    await video.play();
    await started;
    setText(spoken, `The recording starts in ${COUNTDOWN} seconds.`);
    for (let left = COUNTDOWN; left > 0 && !cancelled.signal.aborted; left--) {
      setText(status, `${left}`);
      await oneSecond(cancelled.signal);
    }
    if (cancelled.signal.aborted) return null;
    stop.hidden = false;
    stop.focus();
    setText(spoken, 'Recording.');
    return await record(stream, { store, playback, status, done: done.signal, cancelled: cancelled.signal });
  } finally {
    for (const track of stream.getTracks()) track.stop();
    window.removeEventListener('keydown', onKey, { capture: true });
    giveBackFocus(dialog);
    dialog.remove();
  }
}

async function openCamera(): Promise<MediaStream> {
  // Missing on insecure origins.
  const devices = navigator.mediaDevices as MediaDevices | undefined;
  try {
    if (!devices) throw new DOMException('no media devices', 'SecurityError');
    return await devices.getUserMedia({
      video: { width: { ideal: 1280 }, height: { ideal: 720 }, frameRate: { ideal: 30 } },
    });
  } catch (cause) {
    const name = cause instanceof DOMException ? cause.name : '';
    throw new AppError(
      'camera-refused',
      name === 'NotFoundError' ? 'No camera was found.' : 'The camera may not be used by this page.',
      name === 'NotFoundError'
        ? 'Connect a camera, or film with a phone and drop the video here.'
        : 'Allow the camera in the browser’s address bar and try again, or film with a phone and drop the video here.',
      { cause },
    );
  }
}

interface Recording {
  readonly store: Store;
  readonly playback: Pick<Services, 'seek' | 'togglePlay'>;
  readonly status: HTMLElement;
  /** Aborted when the recording is to end. */
  readonly done: AbortSignal;
  readonly cancelled: AbortSignal;
}

/**
 * Records until the visitor has enough. A recorder that ends by itself, as when the camera is unplugged, leaves what was
 * recorded until then.
 */
async function record(
  stream: MediaStream,
  { store, playback, status, done, cancelled }: Recording,
): Promise<File | null> {
  if (!stream.active) throw cameraStopped();
  const type = TYPES.find((one) => MediaRecorder.isTypeSupported(one));
  const recorder = new MediaRecorder(stream, type === undefined ? {} : { mimeType: type });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const early = new AbortController();
  const stopped = new Promise<void>((resolve) => {
    recorder.onstop = () => {
      early.abort();
      resolve();
    };
  });
  // After an error it stops, with what it has.
  recorder.onerror = () => {
    early.abort();
  };
  const play = (on: boolean): void => {
    if (store.getState().playback.playing !== on) playback.togglePlay();
  };
  recorder.start(1000);
  const { speed, loop } = store.getState().playback;
  if (store.getState().song) {
    // The song is taken to run on from where it begins.
    apply(store, playbackSet({ speed: 1, loop: false }));
    playback.seek(0);
    play(true);
  }
  const end = AbortSignal.any([done, cancelled, early.signal]);
  for (let second = 0; second < MAX_SECONDS && !end.aborted; second++) {
    setText(status, `Recording, ${second} of at most ${MAX_SECONDS} s`);
    await oneSecond(end);
  }
  const byItself = early.signal.aborted;
  if (recorder.state !== 'inactive') recorder.stop();
  play(false);
  apply(store, playbackSet({ speed, loop }));
  await stopped;
  if (cancelled.aborted) return null;
  const kind = recorder.mimeType.startsWith('video/mp4') ? 'mp4' : 'webm';
  const file = new File(parts, `camera.${kind}`, { type: `video/${kind}` });
  if (file.size === 0) throw cameraStopped();
  // Said by the page: the dialog closes.
  apply(
    store,
    toastShown(byItself ? 'The camera has stopped, and the recording with it.' : 'The recording has ended.'),
  );
  return file;
}

function cameraStopped(): AppError {
  return new AppError(
    'camera-stopped',
    'The camera stopped before anything was recorded.',
    'Check that it is connected and that this page may use it, then try again.',
  );
}

/** Resolves after a second, or at once when the signal is aborted. */
function oneSecond(signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, 1000);
    signal.addEventListener('abort', () => {
      clearTimeout(timer);
      resolve();
    });
  });
}
