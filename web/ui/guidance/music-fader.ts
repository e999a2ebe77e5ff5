import { el, setText, combineDisposers } from '../widgets/dom';
import type { FaderRange } from '../widgets/fader';
import { createMiniFader } from './mini-fader';
import type { Mount } from '../store/services';
import { musicReset, musicSet } from '../store/actions/settings';
import { apply, watchAll } from '../store/store';

const HINT = 'How strongly the song shapes the dance, beside the other dancer.';

/** The fader of the guidance weight of the music; disabled while there is no song. */
export const mountMusicFader: Mount = (root, store) => {
  const fader = createMiniFader(
    'Music guidance',
    HINT,
    {
      change: (value) => {
        apply(store, musicSet(value));
      },
      reset: () => {
        apply(store, musicReset());
      },
    },
    musicText,
  );
  const note = el('small');
  const row = el(
    'div',
    { class: 'music-row' },
    el('span', { class: 'name', text: 'Music', attributes: { title: HINT } }),
    fader.root,
    note,
  );
  root.append(row);
  return combineDisposers(
    watchAll(
      store,
      ({ settings, manifest, song }) => [settings?.music, manifest, song !== null],
      ({ settings, manifest, song }) => {
        fader.show(song && manifest ? manifest.guidance.music : null, settings?.music ?? 0);
        setText(note, song || !settings ? '' : 'no song');
      },
    ),
    () => {
      row.remove();
    },
  );
};

/** Text of a value for screen readers. */
function musicText(value: number, { max }: FaderRange): string {
  const share = value / max;
  const strength =
    value === 0 ? 'as it comes' : share < 0.4 ? 'a little more' : share < 0.75 ? 'clearly' : 'strongly';
  return `${value.toFixed(2)}, the song is heard ${strength}`;
}
