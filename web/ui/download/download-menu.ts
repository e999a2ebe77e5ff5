import { el, setAttribute, setText, setVariable, together } from '../widgets/dom';
import { createDownloadMotion } from './download-motion';
import { createDownloadVideo } from './download-video';
import { icon } from '../widgets/icons';
import type { Mount } from '../store/services';
import type { AppState } from '../store/state';
import { apply, watch, watchAll } from '../store/store';
import { panelToggled } from '../store/actions/view';

/**
 * The Download button and its menu: whose motion, in which format and under which name, and the video. A video goes on
 * while the menu is closed; the button then shows how far it is.
 */
export const mountDownloadMenu: Mount = (root, store, services) => {
  const toggle = (): void => {
    apply(store, panelToggled('download'));
  };
  const attributes = { type: 'button', 'aria-haspopup': 'dialog', 'aria-label': 'Download' };
  const button = (kind: string, sign: SVGSVGElement, text: string | null) => {
    const ring = el('span', { class: 'ring', attributes: { 'aria-hidden': true } });
    const element = el('button', { class: kind, attributes, on: { click: toggle } }, ring, sign, text);
    return { element, ring, sign };
  };
  const wide = button('btn primary desk', icon('download'), 'Download');
  const narrow = button('icon phone-only', icon('share'), null);
  const motion = createDownloadMotion(store, services);
  const video = createDownloadVideo(store, services);
  const menu = el(
    'div',
    { class: 'float menu', attributes: { role: 'dialog', 'aria-label': 'Download' } },
    ...motion.parts,
    video.part,
  );
  menu.hidden = true;
  const door = el('button', {
    class: 'btn tint project-door',
    text: 'Open or save a project',
    attributes: { type: 'button' },
    on: {
      click: () => {
        apply(store, panelToggled('project'));
      },
    },
  });
  menu.append(door);
  // Read out at the start, half way and at the end, not at every picture.
  const spoken = el('p', { class: 'vh', attributes: { role: 'status' } });
  root.append(wide.element, narrow.element, menu, spoken);

  const showButtons = ({ reaction, videoProgress, saved }: AppState): void => {
    const share = videoProgress && videoProgress.frame / videoProgress.frames;
    for (const { element, ring, sign } of [wide, narrow]) {
      element.disabled = reaction === null && !videoProgress;
      element.title = videoProgress
        ? `Writing the video, ${Math.round(100 * (share ?? 0))} %`
        : reaction
          ? ''
          : 'Ready when a reactor is on the stage';
      ring.hidden = !videoProgress;
      sign.toggleAttribute('hidden', videoProgress !== null);
      setVariable(ring, '--part', share ?? 0);
    }
    if (videoProgress)
      setText(spoken, (share ?? 0) < 0.5 ? 'The video is being written.' : 'The video is half done.');
    else setText(spoken, saved ? `Saved ${saved.name}.` : '');
  };
  const showOpen = (open: boolean): void => {
    const before = menu.hidden;
    menu.hidden = !open;
    for (const { element } of [wide, narrow]) setAttribute(element, 'aria-expanded', open ? 'true' : 'false');
    if (open) {
      motion.focus();
    } else if (
      !before &&
      (menu.contains(document.activeElement) || document.activeElement === document.body)
    ) {
      (wide.element.offsetParent ? wide : narrow).element.focus();
    }
  };
  const closeOutside = (event: PointerEvent): void => {
    const target = event.target as Node;
    const inside = [menu, wide.element, narrow.element].some((part) => part.contains(target));
    if (!menu.hidden && !inside) toggle();
  };
  document.addEventListener('pointerdown', closeOutside);
  return together(
    watchAll(store, (state) => [state.reaction, state.videoProgress, state.saved], showButtons),
    watch(store, (state) => state.openPanel === 'download', showOpen),
    motion.dispose,
    video.dispose,
    () => {
      document.removeEventListener('pointerdown', closeOutside);
      for (const part of [wide.element, narrow.element, menu, spoken]) part.remove();
    },
  );
};
