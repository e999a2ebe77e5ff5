import { chosenPart } from './dance';
import { textButton } from '../widgets/button';
import { el, setText } from '../widgets/dom';
import { radioGroup } from '../widgets/radio-group';
import { downloadChosen } from '../store/actions/download';
import { regionEndSetOnBeat } from '../store/actions/timeline';
import { clockTime } from '../store/format';
import { apply, type Store, watchAll } from '../store/store';

/** Part of the download menu: whether motions and videos are of the whole dance or of the loop, and how to draw one. */
export function createDownloadPart(store: Store): readonly HTMLElement[] {
  const chosen = el('span');
  const hint = el('span', { class: 'ruler-hint', text: '. For a part, drag a loop on the ruler.' });
  const parts = radioGroup(
    'Part of the dance',
    [
      ['whole', 'Whole dance'],
      ['loop', 'Loop'],
    ],
    (part) => {
      apply(store, downloadChosen({ part }));
    },
  );
  /** On phones, which have no ruler: an end of the loop where the playhead is, as the keys I and O set it. */
  const endButton = (end: 'from' | 'to', text: string): HTMLElement =>
    textButton('btn tint', text, () => {
      apply(store, regionEndSetOnBeat(end, store.getState().playback.time));
      apply(store, downloadChosen({ part: 'loop' }));
    });
  watchAll(
    store,
    ({ reaction, download, playback }) => [reaction, download.part, playback.region],
    (state) => {
      const part = chosenPart(state);
      const drawn = state.playback.region !== null;
      parts.element.hidden = !drawn;
      hint.hidden = drawn;
      parts.show(part ? 'loop' : 'whole');
      if (part) setText(chosen, `${clockTime(part.from)} to ${clockTime(part.to)}`);
      else setText(chosen, drawn ? '' : 'Whole dance');
    },
  );
  return [
    el(
      'div',
      { class: 'row' },
      el('h2', { text: 'Part' }),
      el('span', { class: 'soft' }, chosen, hint),
      parts.element,
    ),
    el(
      'div',
      { class: 'row no-ruler' },
      el('span', { class: 'soft', text: 'Loop' }),
      endButton('from', 'Start here'),
      endButton('to', 'End here'),
    ),
  ];
}
