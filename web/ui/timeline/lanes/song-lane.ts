import { columnsOf } from '../../../audio/client';
import { el, setText } from '../../widgets/dom';
import { drawBeats, drawWave, surface, token } from '../../widgets/lane-canvas';
import { accentOf, type CountedBeats } from '../../store/counting';
import { danceDuration } from '../../store/selectors';
import type { Services } from '../../store/services';
import { ShiftHandle, type ShiftHandleOptions } from '../shift-handle';
import { songStart } from '../../store/song-shift';
import type { LoadedSong } from '../../store/reaction';
import type { AppState } from '../../store/state';
import type { Store } from '../../store/store';
import type { TimeScale } from '../../store/time-scale';

/** How the lane is drawn; `shift` may be one that is still being dragged. */
interface SongLaneView {
  readonly scale: TimeScale;
  /** Frames. */
  readonly shift: number;
  readonly beats: CountedBeats;
}

/** The lane of the song: waveform and beats, brighter where it has been played; dragging shifts the song. */
export class SongLane {
  readonly root: HTMLElement;
  readonly #wave = createWaveform();
  readonly #shift: ShiftHandle;

  constructor(store: Store, services: Services, options: ShiftHandleOptions) {
    this.#shift = new ShiftHandle(store, services, options);
    this.root = el('div', { class: 'lane song' }, this.#wave.root, this.#shift.handle, this.#shift.text);
  }

  draw(state: AppState, picture: SongLaneView): void {
    this.#shift.describe(state, picture.shift);
    this.#wave.draw(state, picture);
  }

  /** The slider that shifts the song. */
  get handle(): HTMLElement {
    return this.#shift.handle;
  }

  /** Brightens the waveform up to `time`, seconds of the dance. */
  showPlayed(time: number, scale: TimeScale): void {
    this.#wave.showPlayed(time, scale);
  }
}

/** The waveform, drawn twice over each other: the bright one is clipped to what has been played. */
function createWaveform(): {
  readonly root: HTMLElement;
  readonly draw: (state: AppState, picture: SongLaneView) => void;
  readonly showPlayed: (time: number, scale: TimeScale) => void;
} {
  const canvas = el('canvas');
  const playedCanvas = el('canvas');
  const played = el('div', { class: 'played' }, playedCanvas);
  const note = el('div', { class: 'none' });
  const root = el('div', { class: 'waveform', attributes: { role: 'img' } }, canvas, played, note);

  const drawSong = (song: LoadedSong, state: AppState, { scale, shift, beats }: SongLaneView): void => {
    const start = songStart({ leader: state.leader, shift });
    const columns = Math.max(1, Math.round(scale.width * Math.min(2, window.devicePixelRatio)));
    const span = { from: scale.from - start, to: scale.to - start };
    const shape = columnsOf(song.data.waveform, span, columns);
    const colours = {
      bar: token(root, '--text-2'),
      beat: token(root, '--control-line'),
      line: token(root, '--line'),
    };
    const marks = beats.times.map((time, index) => ({ time, accent: accentOf(beats, index) }));
    for (const [each, colour] of [
      [canvas, '--wave'],
      [playedCanvas, '--wave-played'],
    ] as const) {
      const on = surface(each);
      if (!on) continue;
      drawBeats(on, marks, scale, colours);
      drawWave(on, shape, token(root, colour));
    }
  };
  return {
    root,
    draw: (state, picture) => {
      const { song } = state;
      note.hidden = song !== null || danceDuration(state) === 0;
      setText(note, state.reading.song ? 'Reading the song' : 'No song: silence');
      const label = song ? `Waveform of ${song.name}, ${picture.beats.times.length} beats` : 'No song';
      root.setAttribute('aria-label', label);
      const isDrawn = song !== null && picture.scale.to > picture.scale.from;
      // Chromium may go on showing what was drawn on a canvas that is only emptied.
      canvas.hidden = playedCanvas.hidden = !isDrawn;
      if (isDrawn) drawSong(song, state, picture);
    },
    showPlayed: (time, scale) => {
      const share = scale.width > 0 ? Math.min(1, Math.max(0, scale.x(time) / scale.width)) : 0;
      played.style.clipPath = `inset(0 ${(100 - share * 100).toFixed(3)}% 0 0)`;
    },
  };
}
