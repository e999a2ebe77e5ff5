import { el, setText } from './dom';
import { frameWords, shiftWords, signed, suggestedShift } from './song-shift';
import type { AppState } from './state';
import { apply, type Store } from './store';
import { shiftSet } from './timeline-changes';

/** The song's name in the lanes, with how it is shifted and how it would fit better. */
export interface SongLabel {
  readonly root: HTMLElement;
  readonly show: (state: AppState) => void;
}

/** The label; its two buttons come and go without moving anything. */
export function createSongLabel(store: Store): SongLabel {
  const back = el('button', {
    class: 'shifted',
    attributes: { type: 'button' },
    on: {
      click: () => {
        apply(store, shiftSet(0));
      },
    },
  });
  const align = el('button', {
    class: 'align',
    attributes: { type: 'button' },
    on: {
      click: () => {
        const state = store.getState();
        const found = suggestedShift(state);
        if (found) apply(store, shiftSet(state.shift + found.by));
      },
    },
  });
  const root = el(
    'div',
    { class: 'lab song' },
    el('span', { class: 'of-song' }, el('span', { text: 'Song' }), back),
    align,
  );
  return {
    root,
    show: (state) => {
      const { shift } = state;
      back.hidden = shift === 0;
      setText(back, `${signed(shift)} ×`);
      back.setAttribute('aria-label', `Song shift ${frameWords(shift)}: put it back`);
      back.title = `The song is shifted by ${shiftWords(shift, state)}. Click to put it back.`;
      const found = suggestedShift(state);
      align.hidden = found === null;
      if (!found) return;
      setText(align, `Align ${frameWords(found.by)}`);
      align.title =
        `The leader's accents, the moments of least speed, meet the song's beats better ` +
        `${shiftWords(found.by, state).split(', ')[1] ?? ''}: ${percent(found.score)} instead of ${percent(found.before)}. ` +
        'Click to shift the song.';
    },
  };
}

function percent(part: number): string {
  return `${Math.round(part * 100)} %`;
}
