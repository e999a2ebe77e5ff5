import type { PictureSize } from '../../common/picture';
import { VIDEO_SIZES, type VideoPlan } from '../../export/client';
import { chosenPart, fileNameParts, savedVideo } from './dance';
import { createDownloadPicture } from './download-picture';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { createMeter } from '../widgets/meter';
import { downloadChosen } from '../store/actions/download';
import { videoFileName } from './file-name';
import { byteSize, duration } from '../store/format';
import { radioGroup } from '../widgets/radio-group';
import { danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState, VideoProgress } from '../store/state';
import { apply, type Store, watchAll } from '../store/store';

/** Part of the download menu: the video of the stage, its size and its progress, and a picture of the same size. */
export function createDownloadVideo(store: Store, services: Services): HTMLElement {
  /** How the video would be written; undefined until the browser has answered. */
  let plan: Plan;
  const sizes = radioGroup(
    'Size of the video',
    VIDEO_SIZES.map((size) => [size, size === 'stage' ? 'As on stage' : size.replace('x', ':')] as const),
    (size) => {
      apply(store, downloadChosen({ size }));
    },
  );
  const head = createHead(services);
  const sizeRow = el('div', { class: 'row' }, el('span', { class: 'soft', text: 'Size' }), sizes.element);
  const captions = [
    captionField(store, 'title', 'Title', 'In the first seconds'),
    captionField(store, 'credit', 'Credit', 'Below the whole video'),
  ];
  const beside = createBeside(store, services);
  const progress = createProgress();
  const picture = createDownloadPicture(services);
  const part = el(
    'section',
    { class: 'video', attributes: { 'aria-label': 'Video and picture' } },
    head.root,
    sizeRow,
    ...beside.rows,
    ...captions,
    progress.root,
    picture.root,
  );

  const show = (state: AppState): void => {
    const focused = part.contains(document.activeElement) ? document.activeElement : null;
    head.show(state, plan);
    for (const row of [sizeRow, ...captions]) row.hidden = state.videoProgress !== null;
    beside.show(state);
    sizes.show(state.download.size);
    progress.show(state.videoProgress);
    picture.show(state);
    if (focused instanceof HTMLElement && !focused.offsetParent) head.focus(state);
  };
  let lastRequest = 0;
  /** Asks the browser how it can write the video, while the menu is open; only the latest answer counts. */
  const ask = async (state: AppState): Promise<void> => {
    if (state.openPanel !== 'download') return;
    const request = ++lastRequest;
    // A request that fails, because the page is offline, is repeated when the menu is opened again.
    const answer = await services.planVideo().catch(() => undefined);
    if (request !== lastRequest) return;
    plan = answer;
    show(store.getState());
  };
  watchAll(
    store,
    (state) => [
      state.videoProgress,
      state.leader,
      state.reaction,
      state.takes,
      state.footLock,
      state.download,
      state.playback.region,
      state.saved,
      state.writing,
    ],
    show,
  );
  watchAll(
    store,
    (state) => [state.openPanel, state.download.size, state.reaction?.inputs.song],
    (state) => void ask(state),
  );
  return part;
}

/**
 * Whether the leader's video is shown beside the dance. Only its motion is stored: who comes back to a leader from a
 * video is told why the choice is not there.
 */
function createBeside(
  store: Store,
  services: Services,
): { readonly rows: readonly HTMLElement[]; readonly show: (state: AppState) => void } {
  const box = el('input', {
    attributes: { type: 'checkbox', id: 'beside-video' },
    on: {
      change: () => {
        apply(store, downloadChosen({ beside: box.checked }));
      },
    },
  });
  const choice = el(
    'label',
    { class: 'row soft', attributes: { for: box.id } },
    'Show the leader’s video beside it',
    box,
  );
  const missing = el('p', {
    class: 'row soft',
    text: 'The leader’s video was not kept. To show it beside the dance, open it again.',
  });
  return {
    rows: [choice, missing],
    show: ({ videoProgress, download }) => {
      const video = videoProgress ? 'none' : services.leaderVideo();
      choice.hidden = video !== 'open';
      missing.hidden = video !== 'gone';
      box.checked = download.beside;
    },
  };
}

/** A line of text that is written into the video. */
function captionField(
  store: Store,
  which: 'title' | 'credit',
  name: string,
  placeholder: string,
): HTMLElement {
  const input = el('input', {
    class: 'caption',
    attributes: { type: 'text', maxlength: 120, placeholder, 'aria-label': `${name} of the video` },
    on: {
      input: () => {
        apply(store, downloadChosen({ [which]: input.value }));
      },
    },
  });
  return el('div', { class: 'row' }, el('span', { class: 'soft', text: name }), input);
}

type Plan = VideoPlan | null | undefined;

/** The heading, what will be written, and the buttons. */
function createHead(services: Services): {
  readonly root: HTMLElement;
  readonly show: (state: AppState, plan: Plan) => void;
  /** Puts the focus on the button that goes on from here. */
  readonly focus: (state: AppState) => void;
} {
  const about = el('span', { class: 'soft' });
  const save = textButton('btn tint', 'Save video', services.saveVideo);
  const cancel = textButton('btn tint', 'Cancel', services.cancelVideo);
  const share = textButton('btn tint', 'Share', services.shareSaved);
  share.setAttribute('aria-label', 'Share the video');
  cancel.setAttribute('aria-label', 'Cancel the video');
  const title = el('h3', { text: 'Video with the song' });
  return {
    root: el('div', { class: 'row' }, title, about, share, save, cancel),
    show: (state, plan) => {
      const running = state.videoProgress !== null;
      save.hidden = running;
      cancel.hidden = !running;
      share.hidden = running || !(plan && savedVideo(state, plan.container)?.shareable);
      save.disabled = !state.reaction || !plan;
      const size = services.videoSize();
      setText(about, size ? videoText(plan, state, size) : 'A video needs the 3D view.');
      const named = fileNameParts(state);
      save.title = named && plan ? videoFileName(named, state.download.size, plan.container) : '';
    },
    focus: ({ videoProgress }) => {
      (videoProgress ? cancel : save).focus();
    },
  };
}

/** Frames written and time left. */
function createProgress(): {
  readonly root: HTMLElement;
  readonly show: (videoProgress: VideoProgress | null) => void;
} {
  const meter = createMeter('Video');
  const count = el('span', { class: 'grow' });
  const left = el('span');
  const root = el('div', { class: 'row progress-row' }, meter.element, count, left);
  return {
    root,
    show: (videoProgress) => {
      root.hidden = videoProgress === null;
      if (!videoProgress) return;
      const { frame, frames } = videoProgress;
      meter.show(frame / frames);
      setText(count, `Frame ${frame.toLocaleString('en')} of ${frames.toLocaleString('en')}`);
      setText(left, videoProgress.secondsLeft === null ? '' : timeLeft(videoProgress.secondsLeft));
    },
  };
}

/** Text beside the heading: what will be written, what was, or why no video can be written. */
function videoText(plan: Plan, state: AppState, { width, height }: PictureSize): string {
  if (plan === undefined) return '';
  if (plan === null) return 'Not in this browser: a current Chrome, Edge, Firefox or Safari can.';
  const saved = savedVideo(state, plan.container);
  if (saved && !state.videoProgress) return `Saved, ${byteSize(saved.bytes)}`;
  const container = plan.container === 'mp4' ? 'MP4' : 'WebM';
  if (plan.way === 'record') {
    const part = chosenPart(state);
    return `${container}, takes ${duration(part ? part.to - part.from : danceDuration(state))}`;
  }
  return `${container}, ${width} × ${height}`;
}

/** `6 s left`, `2:05 left`. */
function timeLeft(seconds: number): string {
  return seconds < 60 ? `${seconds} s left` : `${duration(seconds)} left`;
}
