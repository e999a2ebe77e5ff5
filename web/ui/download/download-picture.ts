import { savedPicture } from './dance';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { byteSize } from '../store/format';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';

/** Row of the download menu: a picture of the moment that the stage shows, in the size of a video. */
export function createDownloadPicture(services: Services): {
  readonly root: HTMLElement;
  readonly show: (state: AppState) => void;
} {
  const about = el('span', { class: 'soft' });
  const save = textButton('btn tint', 'Save picture', services.savePicture);
  const share = textButton('btn tint', 'Share', services.shareSaved);
  share.setAttribute('aria-label', 'Share the picture');
  const root = el('div', { class: 'row' }, el('h3', { text: 'Picture' }), about, share, save);
  return {
    root,
    show: (state) => {
      const size = services.videoSize();
      const saved = savedPicture(state);
      root.hidden = state.videoProgress !== null || !size;
      save.disabled = !state.reaction || state.writing !== null;
      share.hidden = !saved?.shareable;
      if (!size) return;
      if (state.writing === 'png') setText(about, 'Writing');
      else
        setText(
          about,
          saved ? `Saved, ${byteSize(saved.bytes)}` : `This moment, PNG, ${size.width} × ${size.height}`,
        );
    },
  };
}
