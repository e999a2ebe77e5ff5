import { iconButton, textButton } from '../widgets/button';
import { el, setHidden, setText, UNTRANSLATED } from '../widgets/dom';
import { clockTime, rate } from '../store/format';
import { icon } from '../widgets/icons';
import { isReading, danceDuration, firstNote } from '../store/selectors';
import type { Mount, Services } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store, watch, watchAll } from '../store/store';
import { playbackSet, SPEEDS } from '../store/actions/view';
import { createCountMenu } from './count-menu';
import { createZoomControl } from './zoom-control';

/** The transport: play, jump to the ends, time and count, speed, loop, a note about the files, and zoom. */
export const mountTransport: Mount = (root, store, services) => {
  const start = iconButton(
    'icon desk',
    'start',
    { label: 'To the start', title: 'To the start (Home)' },
    () => {
      services.seek(0);
    },
  );
  const end = iconButton('icon desk', 'end', { label: 'To the end', title: 'To the end (End)' }, () => {
    services.seek(danceDuration(store.getState()));
  });
  const play = createPlayButton(store, services);
  const clock = createClock(store);
  const count = createCountMenu(store);
  const speed = createSpeedMenu(store);
  const loop = createLoopButton(store);
  const note = el('span', { class: 'file-note' });
  const halfRate = createHalfRateButton(store, services, play);
  const line = el(
    'div',
    { class: 'transport', attributes: { role: 'group', 'aria-label': 'Transport' } },
    start,
    play,
    end,
    clock,
    count,
    speed,
    loop,
    el('span', { class: 'grow' }),
    note,
    halfRate,
    createZoomControl(store),
  );
  root.append(line);
  watchAll(
    store,
    (state) => [state.leader, state.song],
    (state) => {
      const empty = danceDuration(state) === 0;
      for (const button of [start, play, end, loop]) button.disabled = empty;
    },
  );
  watchAll(
    store,
    (state) => [
      state.leader,
      state.song,
      state.shift,
      state.reaction?.unfamiliarity,
      state.manifest,
      ...isReading(state),
    ],
    (state) => {
      showNote(note, state);
    },
  );
};

/** What is worth knowing about the files, in one sentence; nothing where the button for the frame rate has its place. */
function showNote(element: HTMLElement, state: AppState): void {
  element.hidden = halfRateOf(state) !== null;
  const note = firstNote(state);
  setText(element, note?.text ?? '');
  element.title = element.textContent;
  element.classList.toggle('warning', note?.isWarning ?? false);
}

/** Half the frame rate that the leader's file states, where that may be the right one. */
function halfRateOf({ leader }: AppState): number | null {
  return leader?.file.report.halfRate ?? null;
}

/**
 * Reads the leader again at half the frame rate, where the dancer moves faster than people do.
 * @param next gets the focus when the button goes
 */
function createHalfRateButton(
  store: Store,
  { rereadLeader }: Services,
  next: HTMLElement,
): HTMLButtonElement {
  const element = textButton(
    'half-rate',
    '',
    () => {
      const { leader } = store.getState();
      const fps = halfRateOf(store.getState());
      if (leader && fps !== null) rereadLeader(leader, { ...leader.options, fps });
    },
    { title: 'The leader moves faster than people do: the frame rate of the file may be wrong' },
  );
  watch(store, halfRateOf, (fps) => {
    setHidden(element, fps === null, next);
    setText(element, fps === null ? '' : `Leader too fast? Read it at ${rate(fps)} fps`);
  });
  return element;
}

function createPlayButton(store: Store, { togglePlay }: Services): HTMLButtonElement {
  const element = iconButton('play', 'play', { label: 'Play', title: 'Play or pause (Space)' }, togglePlay);
  watch(
    store,
    (state) => state.playback.playing,
    (playing) => {
      element.replaceChildren(icon(playing ? 'pause' : 'play'));
      element.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    },
  );
  return element;
}

/** Time of the playhead and duration of the dance. */
function createClock(store: Store): HTMLElement {
  const now = el('span', { class: 'now' });
  const of = el('span', { class: 'of' });
  const element = el('div', { class: 'clock', attributes: UNTRANSLATED }, now, ' ', of);
  watchAll(
    store,
    (state) => [state.playback.time, state.leader, state.song],
    (state) => {
      setText(now, clockTime(state.playback.time));
      setText(of, `/ ${clockTime(danceDuration(state))}`);
    },
  );
  return element;
}

function createSpeedMenu(store: Store): HTMLElement {
  const element = el(
    'select',
    {
      class: 'speed',
      attributes: { 'aria-label': 'Speed' },
      on: {
        change: () => {
          apply(store, playbackSet({ speed: Number(element.value) }));
        },
      },
    },
    ...SPEEDS.map((value) => el('option', { text: `${value}×`, attributes: { value } })),
  );
  watch(
    store,
    (state) => state.playback.speed,
    (value) => {
      element.value = String(value);
    },
  );
  return element;
}

function createLoopButton(store: Store): HTMLButtonElement {
  const title = 'Play again from the start at the end (L). Drag on the ruler to loop a part';
  const element = iconButton('icon', 'loop', { label: 'Loop', title }, () => {
    apply(store, playbackSet({ loop: !store.getState().playback.loop }));
  });
  watchAll(
    store,
    (state) => [state.playback.loop, state.playback.region],
    ({ playback: { loop, region } }) => {
      element.setAttribute('aria-pressed', String(loop));
      const part = region ? `Loop ${clockTime(region.from)} to ${clockTime(region.to)}` : 'Loop';
      element.setAttribute('aria-label', part);
    },
  );
  return element;
}
