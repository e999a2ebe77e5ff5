import { textButton } from '../widgets/button';
import { el, setHidden, setText } from '../widgets/dom';
import { percent } from '../store/format';
import { shiftAdvice, frameCountText, shiftText, signed } from '../store/song-shift';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { shiftSet } from '../store/actions/timeline';

/** The label of the song lane: the shift, with a button that resets it, and one that aligns the song. */
interface SongLabel {
  readonly root: HTMLElement;
  /** Shows the shift now, and how well the song fits in a task of its own: with a long dance it takes long to find. */
  readonly show: (state: AppState) => void;
}

/** @param handle the slider of the shift, which gets the focus of a button that goes */
export function createSongLabel(store: Store, handle: HTMLElement): SongLabel {
  const back = textButton('shifted', '', () => {
    apply(store, shiftSet(0));
  });
  const align = textButton('align', '', () => {
    const state = store.getState();
    const better = shiftAdvice(state)?.better;
    if (better) apply(store, shiftSet(state.shift + better.by));
  });
  const none = el('span', { class: 'well-aligned' });
  const root = el(
    'div',
    { class: 'lane-label song' },
    el('span', { class: 'song-name' }, el('span', { text: 'Song' }), back),
    align,
    none,
  );
  let timer: ReturnType<typeof setTimeout> | undefined;
  const showFit = (): void => {
    const state = store.getState();
    const fit = shiftAdvice(state);
    setHidden(align, !fit?.better, handle);
    none.hidden = !fit || fit.better !== null;
    if (!fit) return;
    if (!fit.better) {
      setText(none, fit.summary);
      none.title = fit.reason;
      return;
    }
    const { by, score, before } = fit.better;
    setText(align, `Align ${frameCountText(by)}`);
    align.title =
      `If the song starts ${shiftText(by, state).split(', ')[1] ?? ''}, its beats fit the leader’s accents better: ` +
      `${percent(score)} instead of ${percent(before)}. ` +
      'Click to move the song.';
  };
  return {
    root,
    show: (state) => {
      const { shift } = state;
      setHidden(back, shift === 0, handle);
      setText(back, `${signed(shift)} ×`);
      back.setAttribute('aria-label', `Song shift ${frameCountText(shift)}: move it back`);
      back.title = `The song is moved by ${shiftText(shift, state)}. Click to move it back.`;
      clearTimeout(timer);
      timer = setTimeout(showFit);
    },
  };
}
