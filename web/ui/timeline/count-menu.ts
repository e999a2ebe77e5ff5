import { countingSet, oneSet, settingOneSet } from '../store/actions/counting';
import { panelToggled } from '../store/actions/view';
import { barAt, countedBeats, countingOf, isOf, tempoText } from '../store/counting';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';
import { setDisabled, textButton } from '../widgets/button';
import { el, onPressOutside, setAttribute, setOpen, setText } from '../widgets/dom';
import { radioGroup } from '../widgets/radio-group';

const RATES = [
  [0.5, 'Half'],
  [1, 'As found'],
  [2, 'Double'],
] as const;
const BARS = [
  [4, 'Eight'],
  [3, 'Six'],
] as const;

/** Bar and count at the playhead; a click opens what is counted and how. */
export function createCountMenu(store: Store): HTMLElement {
  const toggle = (): void => {
    apply(store, panelToggled('counting'));
  };
  const { button, showPlace } = createButton(toggle);
  const { menu, showChoices } = createMenu(store, toggle);
  const hint = el('p', { class: 'float count-hint', attributes: { role: 'status' } });
  const element = el('div', { class: 'count-corner' }, button, menu, hint);
  watchAll(
    store,
    (state) => [state.playback.time, state.song, state.countings, state.shift, state.leader],
    showPlace,
  );
  watchAll(store, (state) => [state.song, state.countings, state.settingOne], showChoices);
  watch(
    store,
    (state) => state.settingOne,
    (on) => {
      setText(hint, on ? 'Now click the beat on the song.' : '');
    },
  );
  watch(
    store,
    (state) => state.openPanel === 'counting',
    (open) => {
      setOpen(menu, button, open, () => menu.querySelector('button'));
    },
  );
  onPressOutside([element], () => {
    if (!menu.hidden) toggle();
  });
  return element;
}

function createButton(toggle: () => void): {
  readonly button: HTMLButtonElement;
  readonly showPlace: (state: AppState) => void;
} {
  const bar = el('b');
  const count = el('b');
  const button = el(
    'button',
    {
      class: 'count',
      attributes: { type: 'button', 'aria-haspopup': 'dialog', title: 'How the song is counted' },
      on: { click: toggle },
    },
    el('span', { class: 'unit', text: 'Bar ' }),
    bar,
    el('span', { class: 'unit', text: ' Count ' }),
    count,
  );
  const showPlace = (state: AppState): void => {
    const beats = countedBeats(state);
    // Only its words are hidden, so that nothing beside it moves when a song comes.
    button.classList.toggle('none', beats.times.length === 0);
    const place = barAt(beats, state.playback.time);
    setText(bar, place && place.bar > 0 ? String(place.bar) : '–');
    setText(count, place ? String(place.count) : '–');
  };
  return { button, showPlace };
}

function createMenu(
  store: Store,
  close: () => void,
): {
  readonly menu: HTMLElement;
  readonly showChoices: (state: AppState) => void;
} {
  const tempo = el('span', { class: 'tempo' });
  const click = textButton('btn', 'Click a beat', () => {
    const on = !store.getState().settingOne;
    apply(store, settingOneSet(on));
    // On a small screen the beats lie behind the menu.
    if (on) close();
  });
  const here = textButton('btn', 'At the playhead', () => {
    apply(store, oneSet(store.getState().playback.time));
  });
  const bars = radioGroup('Counts of', BARS, (beatsPerBar) => {
    apply(store, countingSet({ beatsPerBar }));
  });
  const rates = radioGroup('Tempo of the count', RATES, (rate) => {
    apply(store, countingSet({ rate }));
  });
  const found = textButton('btn', 'Count as found', () => {
    apply(store, countingSet(null));
  });
  const menu = el(
    'div',
    { class: 'float count-menu', attributes: { role: 'dialog', 'aria-label': 'How the song is counted' } },
    el('div', { class: 'head' }, el('h2', { text: 'Count' }), tempo),
    row('The “1”', el('div', { class: 'group' }, click, here)),
    row('Counts of', bars.element),
    row('Tempo', rates.element),
    found,
  );
  menu.hidden = true;
  const showChoices = ({ song, countings, settingOne }: AppState): void => {
    if (!song) return;
    const { beatsPerBar, rate } = countingOf(song, countings);
    setText(tempo, tempoText(song, countings));
    bars.show(beatsPerBar);
    rates.show(rate);
    setDisabled(found, !countings.some((counting) => isOf(counting, song)));
    setAttribute(click, 'aria-pressed', String(settingOne));
  };
  return { menu, showChoices };
}

function row(name: string, control: HTMLElement): HTMLElement {
  return el('div', { class: 'row' }, el('span', { text: name }), control);
}
