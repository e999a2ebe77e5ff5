import { el, setText, together } from '../widgets/dom';
import { clockTime } from '../store/format';
import { icon, type IconName } from '../widgets/icons';
import { barAt, isReading, danceDuration, firstNote } from '../store/selectors';
import type { Mount } from '../store/services';
import { musicBeats } from '../store/song-shift';
import { apply, watch, watchAll } from '../store/store';
import { playbackSet, SPEEDS } from '../store/actions/view';
import { createZoomControl } from './zoom-control';

/** Play, where we are, how fast. */
export const mountTransport: Mount = (root, store, services) => {
  const start = button('icon desk', 'start', 'To the start', 'To the start (Home)', () => {
    services.seek(0);
  });
  const end = button('icon desk', 'end', 'To the end', 'To the end (End)', () => {
    services.seek(danceDuration(store.getState()));
  });
  const play = button('play', 'play', 'Play', 'Play or pause (Space)', services.togglePlay);
  const now = el('span', { class: 'now' });
  const of = el('span', { class: 'of' });
  const bar = el('b');
  const count = el('b');
  const counted = el(
    'div',
    { class: 'count', attributes: { title: 'Counted in four from the first beat found' } },
    'Bar ',
    bar,
    'Count ',
    count,
  );
  const speed = el(
    'select',
    {
      class: 'speed',
      attributes: { 'aria-label': 'Speed' },
      on: {
        change: () => {
          apply(store, playbackSet({ speed: Number(speed.value) }));
        },
      },
    },
    ...SPEEDS.map((value) => el('option', { text: `${value}×`, attributes: { value } })),
  );
  const loop = button(
    'icon',
    'loop',
    'Loop',
    'Start over at the end; drag on the ruler to loop a part (L)',
    () => {
      apply(store, playbackSet({ loop: !store.getState().playback.loop }));
    },
  );
  const note = el('span', { class: 'silence' });
  const zoom = createZoomControl(store);
  const line = el(
    'div',
    { class: 'transport', attributes: { role: 'group', 'aria-label': 'Transport' } },
    start,
    play,
    end,
    el('div', { class: 'clock' }, now, ' ', of),
    counted,
    speed,
    loop,
    el('span', { class: 'grow' }),
    note,
    zoom.root,
  );
  root.append(line);

  return together(
    watchAll(
      store,
      (state) => [state.leader, state.song, state.shift, ...isReading(state)],
      (state) => {
        const whole = danceDuration(state);
        for (const control of [start, play, end, loop]) control.disabled = whole === 0;
        setText(of, `/ ${clockTime(whole)}`);
        const first = firstNote(state);
        setText(note, first?.text ?? '');
        note.title = note.textContent;
        note.classList.toggle('look', first?.look ?? false);
        // Its room stays, so that nothing beside it moves when a song comes.
        counted.classList.toggle('none', !state.song || state.song.data.beats.length === 0);
      },
    ),
    watchAll(
      store,
      (state) => [state.playback.time, state.song, state.shift],
      (state) => {
        setText(now, clockTime(state.playback.time));
        const place = barAt(musicBeats(state), state.playback.time);
        setText(bar, place ? String(place.bar) : '–');
        setText(count, place ? String(place.count) : '–');
      },
    ),
    watch(
      store,
      (state) => state.playback.playing,
      (playing) => {
        play.replaceChildren(icon(playing ? 'pause' : 'play'));
        play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
      },
    ),
    watch(
      store,
      (state) => state.playback.speed,
      (value) => {
        speed.value = String(value);
      },
    ),
    watchAll(
      store,
      (state) => [state.playback.loop, state.playback.region],
      ({ playback }) => {
        loop.setAttribute('aria-pressed', String(playback.loop));
        const { region } = playback;
        const part = region ? `Loop ${clockTime(region.from)} to ${clockTime(region.to)}` : 'Loop';
        loop.setAttribute('aria-label', part);
      },
    ),
    zoom.dispose,
    () => {
      line.remove();
    },
  );
};

function button(
  className: string,
  sign: IconName,
  label: string,
  title: string,
  run: () => void,
): HTMLButtonElement {
  return el(
    'button',
    { class: className, attributes: { type: 'button', 'aria-label': label, title }, on: { click: run } },
    icon(sign),
  );
}
