import { textButton } from '../widgets/button';
import { el, onPressOutside, setAttribute, setText, setVariable } from '../widgets/dom';
import { createDownloadMotion } from './download-motion';
import { createDownloadPart } from './download-part';
import { createDownloadVideo } from './download-video';
import { icon, type IconName } from '../widgets/icons';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { panelToggled } from '../store/actions/view';

/** A Download button; its icon becomes a ring of progress while a video is written. */
interface MenuButton {
  readonly element: HTMLButtonElement;
  readonly ring: HTMLElement;
  readonly symbol: SVGSVGElement;
}

/**
 * The Download button, wide and for phones narrow, and its menu: part, motion, video and project. A video goes on while the
 * menu is closed; the button then shows its progress.
 */
export const mountDownloadMenu: Mount = (root, store, services) => {
  const toggle = (): void => {
    apply(store, panelToggled('download'));
  };
  const wide = createButton('btn primary desk', 'download', 'Download', toggle);
  const narrow = createButton('icon phone-only', 'share', null, toggle);
  const buttons = [wide, narrow];
  const motion = createDownloadMotion(store, services);
  const project = textButton('btn tint project-button', 'Open or save a project', () => {
    apply(store, panelToggled('project'));
  });
  const menu = el(
    'div',
    { class: 'float menu', attributes: { role: 'dialog', 'aria-label': 'Download' } },
    ...createDownloadPart(store),
    ...motion.parts,
    createDownloadVideo(store, services),
    project,
  );
  menu.hidden = true;
  const spoken = el('p', { class: 'visually-hidden', attributes: { role: 'status' } });
  root.append(wide.element, narrow.element, menu, spoken);

  const showOpen = (open: boolean): void => {
    const wasOpen = !menu.hidden;
    menu.hidden = !open;
    for (const { element } of buttons) setAttribute(element, 'aria-expanded', open ? 'true' : 'false');
    if (open) motion.focus();
    else if (wasOpen && (menu.contains(document.activeElement) || document.activeElement === document.body))
      (wide.element.offsetParent ? wide : narrow).element.focus();
  };
  watchAll(
    store,
    (state) => [state.reaction, state.videoProgress, state.saved],
    (state) => {
      for (const button of buttons) showButton(button, state);
      setText(spoken, announcement(state));
    },
  );
  watch(store, (state) => state.openPanel === 'download', showOpen);
  onPressOutside([menu, wide.element, narrow.element], () => {
    if (!menu.hidden) toggle();
  });
};

function createButton(
  className: string,
  iconName: IconName,
  text: string | null,
  onClick: () => void,
): MenuButton {
  const attributes = { type: 'button', 'aria-haspopup': 'dialog', 'aria-label': 'Download' };
  const ring = el('span', { class: 'ring', attributes: { 'aria-hidden': true } });
  const symbol = icon(iconName);
  const element = el('button', { class: className, attributes, on: { click: onClick } }, ring, symbol, text);
  return { element, ring, symbol };
}

function showButton({ element, ring, symbol }: MenuButton, { reaction, videoProgress }: AppState): void {
  const share = videoProgress ? videoProgress.frame / videoProgress.frames : 0;
  element.disabled = reaction === null && !videoProgress;
  element.title = videoProgress
    ? `Writing the video, ${Math.round(100 * share)} %`
    : reaction
      ? ''
      : 'Available once there is a partner';
  ring.hidden = !videoProgress;
  symbol.toggleAttribute('hidden', videoProgress !== null);
  setVariable(ring, '--part', share);
}

/** Text for screen readers at the start, the middle and the end of a video, not at every frame. */
function announcement({ videoProgress, saved }: AppState): string {
  if (!videoProgress) return saved ? `Saved ${saved.name}.` : '';
  return videoProgress.frame / videoProgress.frames < 0.5
    ? 'The video is being written.'
    : 'The video is half done.';
}
