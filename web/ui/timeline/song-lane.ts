import { loudest, peaks } from './curves';
import { el, setText } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { drawBeats, drawWave, surface, token } from '../widgets/lane-canvas';
import { danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import { shiftRange, shiftWords, songStart } from '../store/song-shift';
import type { AppState, LoadedSong } from '../store/state';
import { apply, type Store } from '../store/store';
import { shiftSet } from '../store/actions/timeline';
import type { TimeScale } from '../store/time-scale';

/** How the lane is drawn now: the shift may be one that is only being tried. */
export interface SongPicture {
  readonly scale: TimeScale;
  readonly shift: number;
  /** Seconds of the dance. */
  readonly musicBeats: readonly number[];
}

/** The song: waveform and beats, brighter where it has been played; dragging shifts it against the leader. */
export interface SongLane {
  readonly root: HTMLElement;
  readonly draw: (state: AppState, picture: SongPicture) => void;
  /** Brightens what lies before the playhead. */
  readonly played: (time: number, scale: TimeScale) => void;
  readonly dispose: () => void;
}

/** What the lane needs of the timeline. */
export interface SongLaneTies {
  readonly scale: () => TimeScale;
  /** Shows a shift while it is being tried; null goes back to the one that holds. */
  readonly onTry: (shift: number | null) => void;
}

/** Frames that an arrow key with Shift moves the song. */
const STRIDE = 10;
/** Time that a shift by keyboard is said in words, milliseconds. */
const WORDS_STAY = 1500;

/** An empty lane. */
export function createSongLane(store: Store, services: Services, { scale, onTry }: SongLaneTies): SongLane {
  const wave = el('canvas');
  const wavePast = el('canvas');
  const past = el('div', { class: 'past' }, wavePast);
  const none = el('div', { class: 'none' });
  const picture = el('div', { class: 'picture-of', attributes: { role: 'img' } }, wave, past, none);
  const grip = el('div', {
    class: 'shift-grip',
    attributes: {
      'data-own-pointer': true,
      role: 'slider',
      tabindex: 0,
      'aria-label': 'Song shift',
      title: 'Drag to shift the song against the leader, double click to put it back; a click jumps here',
    },
  });
  const trying = el('div', { class: 'trying', attributes: { 'aria-hidden': 'true' } });
  trying.hidden = true;
  const root = el('div', { class: 'lane song' }, picture, grip, trying);

  /** The shift that dragging over this distance asks for, held to what is possible. */
  const shiftAt = (distance: number): number => {
    const { from, to, width } = scale();
    const { min, max } = shiftRange(store.getState());
    const { leader, shift } = store.getState();
    const frames = (distance / width) * (to - from) * (leader?.file.clip.fps ?? 0);
    return Math.min(max, Math.max(min, shift + Math.round(frames)));
  };
  const canShift = (): boolean => {
    const { min, max } = shiftRange(store.getState());
    return max > min;
  };
  let silence: ReturnType<typeof setTimeout> | undefined;
  const say = (shift: number): void => {
    trying.hidden = false;
    setText(trying, shiftWords(shift, store.getState()));
  };
  const settle = (): void => {
    trying.hidden = true;
    onTry(null);
  };
  const undoDrag = draggable(grip, {
    begin: () => danceDuration(store.getState()) > 0,
    move: (distance) => {
      if (!canShift()) return;
      const shift = shiftAt(distance);
      clearTimeout(silence);
      say(shift);
      onTry(shift);
    },
    drop: (event) => {
      if (!canShift()) return;
      const distance = event.clientX - downAt;
      settle();
      apply(store, shiftSet(shiftAt(distance)));
    },
    click: (event) => {
      services.seek(scale().time(event.clientX - grip.getBoundingClientRect().left));
      // After a jump the arrow keys stay with the playhead.
      grip.blur();
    },
    cancel: settle,
  });
  let downAt = 0;
  grip.addEventListener('pointerdown', (event) => {
    downAt = event.clientX;
  });
  grip.addEventListener('dblclick', () => {
    apply(store, shiftSet(0));
  });
  grip.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    const back = event.key === 'Backspace' || event.key === 'Delete';
    if ((by === undefined && !back) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { shift } = store.getState();
    apply(store, shiftSet(by === undefined ? 0 : shift + by * (event.shiftKey ? STRIDE : 1)));
    say(store.getState().shift);
    clearTimeout(silence);
    silence = setTimeout(settle, WORDS_STAY);
  });

  /** The song whose loudest sample is known; finding it reads all of the song. */
  let measured: { readonly song: LoadedSong; readonly loudest: number } | null = null;

  const tell = (state: AppState, shift: number): void => {
    const { song } = state;
    const whole = danceDuration(state);
    none.hidden = song !== null || whole === 0;
    setText(none, state.reading.song ? 'Reading the song' : 'No song: silence');
    const words = song ? `Waveform of ${song.name}, ${song.data.beats.length} beats` : 'No song';
    picture.setAttribute('aria-label', words);
    const { min, max } = shiftRange(state);
    grip.setAttribute('aria-disabled', String(max <= min));
    grip.tabIndex = max > min ? 0 : -1;
    grip.setAttribute('aria-valuemin', String(min));
    grip.setAttribute('aria-valuemax', String(max));
    grip.setAttribute('aria-valuenow', String(shift));
    grip.setAttribute('aria-valuetext', shiftWords(shift, state));
  };

  return {
    root,
    draw: (state, { scale: now, shift, musicBeats }) => {
      tell(state, shift);
      const surfaces = [surface(wave), surface(wavePast)] as const;
      const { song } = state;
      if (!song || now.to <= now.from) return;
      if (measured?.song !== song) measured = { song, loudest: loudest(song.data.pcm) };
      const start = songStart({ leader: state.leader, shift });
      const columns = Math.max(1, Math.round(now.width * Math.min(2, window.devicePixelRatio)));
      const span = { from: now.from - start, to: now.to - start };
      const shape = peaks(song.data.pcm, song.data.sampleRate, span, columns);
      const colours = {
        bar: token(root, '--text-2'),
        beat: token(root, '--control-line'),
        line: token(root, '--line'),
      };
      for (const [index, each] of surfaces.entries()) {
        if (!each) continue;
        drawBeats(each, musicBeats, now, colours);
        drawWave(each, shape, measured.loudest, token(root, index === 0 ? '--wave' : '--wave-past'));
      }
    },
    played: (time, now) => {
      const part = now.width > 0 ? Math.min(1, Math.max(0, now.x(time) / now.width)) : 0;
      past.style.clipPath = `inset(0 ${(100 - part * 100).toFixed(3)}% 0 0)`;
    },
    dispose: () => {
      clearTimeout(silence);
      undoDrag();
    },
  };
}
