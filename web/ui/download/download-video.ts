import { VIDEO_SIZES, type VideoPlan } from '../../export/client';
import { namedAfter } from './dance';
import { el, setText, setVariable, together } from '../widgets/dom';
import { downloadChosen } from '../store/actions/download';
import { videoFileName } from './file-name';
import { byteSize, duration } from '../store/format';
import { radioGroup } from '../widgets/radio-group';
import { danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState, Saved } from '../store/state';
import { apply, type Store, watchAll } from '../store/store';

/** Part of the download menu: the video of the stage, its size, how far it is, and its end. */
export function createDownloadVideo(
  store: Store,
  services: Services,
): { readonly part: HTMLElement; readonly dispose: () => void } {
  /** How the video would be written; undefined until the browser has said. */
  let plan: VideoPlan | null | undefined;
  const sizes = radioGroup(
    'Size of the video',
    VIDEO_SIZES.map((size) => [size, size] as const),
    (size) => {
      apply(store, downloadChosen({ size }));
    },
  );
  const about = el('span', { class: 'soft' });
  const save = action('Save video', services.saveVideo);
  const cancel = action('Cancel', services.cancelVideo);
  const share = action('Share', services.shareSaved);
  share.setAttribute('aria-label', 'Share the video');
  cancel.setAttribute('aria-label', 'Cancel the video');
  const fill = el('i');
  const meter = el(
    'span',
    {
      class: 'meter',
      attributes: { role: 'progressbar', 'aria-label': 'Video', 'aria-valuemin': 0, 'aria-valuemax': 100 },
    },
    fill,
  );
  const count = el('span', { class: 'grow' });
  const left = el('span');
  const choosing = el('div', { class: 'row' }, el('span', { class: 'soft', text: 'Size' }), sizes.element);
  const telling = el('div', { class: 'row told' }, meter, count, left);
  const part = el(
    'section',
    { class: 'film', attributes: { 'aria-label': 'Video' } },
    el('div', { class: 'row' }, el('h3', { text: 'Video with the song' }), about, share, save, cancel),
    choosing,
    telling,
  );

  const show = (state: AppState): void => {
    const { videoProgress, reaction } = state;
    const hadFocus = part.contains(document.activeElement);
    const focused = document.activeElement;
    save.hidden = videoProgress !== null;
    cancel.hidden = videoProgress === null;
    share.hidden = videoProgress !== null || !savedVideo(plan, state)?.shareable;
    choosing.hidden = videoProgress !== null;
    telling.hidden = videoProgress === null;
    if (hadFocus && focused instanceof HTMLElement && !focused.offsetParent)
      (videoProgress ? cancel : save).focus();
    save.disabled = !reaction || !plan;
    sizes.show(state.download.size);
    setText(about, services.stageSize() ? aboutWords(plan, state) : 'A video needs the 3D picture.');
    const named = namedAfter(state);
    save.title = named && plan ? videoFileName(named, state.download.size, plan.container) : '';
    if (!videoProgress) return;
    const { frame, frames } = videoProgress;
    setVariable(fill, '--part', frame / frames);
    meter.setAttribute('aria-valuenow', String(Math.round((100 * frame) / frames)));
    setText(count, `Frame ${frame.toLocaleString('en')} of ${frames.toLocaleString('en')}`);
    setText(left, videoProgress.secondsLeft === null ? '' : timeLeft(videoProgress.secondsLeft));
  };
  /** Asks the browser what it can do, when someone looks; only the latest answer counts. */
  let asked = 0;
  const ask = async (state: AppState): Promise<void> => {
    if (state.openPanel !== 'download') return;
    const pixels = services.stageSize();
    sizes.label('stage', pixels ? `As on stage, ${pixels.width} × ${pixels.height}` : 'As on stage');
    const question = ++asked;
    // What could not be asked, because the page has gone offline, is asked again when the menu is opened again.
    const answer = await services.planVideo().catch(() => undefined);
    if (question !== asked) return;
    plan = answer;
    show(store.getState());
  };
  return {
    part,
    dispose: together(
      watchAll(
        store,
        (state) => [state.videoProgress, state.reaction, state.footLock, state.download, state.saved],
        show,
      ),
      watchAll(
        store,
        (state) => [state.openPanel, state.download.size, state.reaction?.inputs.song],
        (state) => void ask(state),
      ),
    ),
  };
}

function action(text: string, run: () => void): HTMLButtonElement {
  return el('button', { class: 'btn tint', text, attributes: { type: 'button' }, on: { click: run } });
}

/** What was written last, if that is a video. */
function savedVideo(plan: VideoPlan | null | undefined, { saved }: AppState): Saved | null {
  return plan && saved?.name.endsWith(`.${plan.container}`) ? saved : null;
}

/** Beside the heading: what will be written, what was, or why it cannot be. */
function aboutWords(plan: VideoPlan | null | undefined, state: AppState): string {
  if (plan === undefined) return '';
  if (plan === null) return 'Not in this browser: a current Chrome, Edge, Firefox or Safari can.';
  const saved = savedVideo(plan, state);
  if (saved && !state.videoProgress) return `Saved, ${byteSize(saved.bytes)}`;
  const container = plan.container === 'mp4' ? 'MP4' : 'WebM';
  const pace = plan.way === 'record' ? `, takes ${duration(danceDuration(state))}` : ', as framed';
  return `${container}${pace}`;
}

/** `6 s left`, `2:05 left`. */
function timeLeft(seconds: number): string {
  return seconds < 60 ? `${seconds} s left` : `${duration(seconds)} left`;
}
