import { el, setText } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import { shiftRange, shiftText } from '../store/song-shift';
import type { AppState } from '../store/state';
import { apply, type Store } from '../store/store';
import { shiftSet } from '../store/actions/timeline';
import type { TimeScale } from '../store/time-scale';
import { timelineClicked } from './timeline-click';

/** What the handle needs of the timeline. */
export interface ShiftHandleOptions {
  readonly scale: () => TimeScale;
  /** Shows a shift (frames) while the song is being dragged; null shows the one that is set. */
  readonly onDragShift: (shift: number | null) => void;
}

/** Frames that an arrow key with Shift moves the song. */
const LARGE_STEP = 10;
/** How long the text of a shift by keyboard is shown. */
const TEXT_SHOWN_MS = 1500;

/** Direction of a step, by key. */
const ARROWS: Readonly<Record<string, number>> = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };

/** The slider over the lane that shifts the song by pointer or keys, and the text that shows the shift meanwhile. */
export class ShiftHandle {
  readonly handle = el('div', {
    class: 'shift-handle',
    attributes: {
      'data-own-pointer': true,
      role: 'slider',
      tabindex: 0,
      'aria-label': 'Song shift',
      title: 'Drag to move the song in time, double click to move it back. A click jumps here',
    },
  });
  readonly text = el('div', { class: 'shift-text', attributes: { 'aria-hidden': 'true' } });
  readonly #store: Store;
  readonly #options: ShiftHandleOptions;
  #hideTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(store: Store, services: Services, options: ShiftHandleOptions) {
    this.#store = store;
    this.#options = options;
    this.text.hidden = true;
    this.handle.addEventListener('dblclick', () => {
      apply(store, shiftSet(0));
    });
    this.handle.addEventListener('keydown', (event) => {
      this.#moveByKey(event);
    });
    this.#listenToDrags(services);
  }

  /** Tells screen readers the shift and its range, frames. */
  describe(state: AppState, shift: number): void {
    const { min, max } = shiftRange(state);
    this.handle.setAttribute('aria-disabled', String(max <= min));
    this.handle.tabIndex = max > min ? 0 : -1;
    this.handle.setAttribute('aria-valuemin', String(min));
    this.handle.setAttribute('aria-valuemax', String(max));
    this.handle.setAttribute('aria-valuenow', String(shift));
    this.handle.setAttribute('aria-valuetext', shiftText(shift, state));
  }

  #listenToDrags(services: Services): void {
    draggable(this.handle, {
      begin: () => danceDuration(this.#store.getState()) > 0,
      move: (distance) => {
        if (!this.#canShift()) return;
        const shift = this.#shiftAfter(distance);
        clearTimeout(this.#hideTimer);
        this.#showText(shift);
        this.#options.onDragShift(shift);
      },
      drop: (distance) => {
        // Also where the song has gone meanwhile, as when it is undone.
        this.#end();
        if (this.#canShift()) apply(this.#store, shiftSet(this.#shiftAfter(distance)));
      },
      click: (event) => {
        const { left } = this.handle.getBoundingClientRect();
        timelineClicked(this.#store, services, this.#options.scale().time(event.clientX - left), event);
        // After a jump the arrow keys move the playhead.
        this.handle.blur();
      },
      cancel: () => {
        this.#end();
      },
    });
  }

  #moveByKey(event: KeyboardEvent): void {
    const by = ARROWS[event.key];
    const back = event.key === 'Backspace' || event.key === 'Delete';
    if ((by === undefined && !back) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { shift } = this.#store.getState();
    apply(this.#store, shiftSet(by === undefined ? 0 : shift + by * (event.shiftKey ? LARGE_STEP : 1)));
    this.#showText(this.#store.getState().shift);
    clearTimeout(this.#hideTimer);
    this.#hideTimer = setTimeout(() => {
      this.#end();
    }, TEXT_SHOWN_MS);
  }

  #showText(shift: number): void {
    this.text.hidden = false;
    setText(this.text, shiftText(shift, this.#store.getState()));
  }

  /** Hides the text and shows the shift that is set. */
  #end(): void {
    this.text.hidden = true;
    this.#options.onDragShift(null);
  }

  #canShift(): boolean {
    const { min, max } = shiftRange(this.#store.getState());
    return max > min;
  }

  /** The shift after a drag over `distance` CSS pixels, within its range; frames. */
  #shiftAfter(distance: number): number {
    const { from, to, width } = this.#options.scale();
    const { min, max } = shiftRange(this.#store.getState());
    const { leader, shift } = this.#store.getState();
    const frames = (distance / width) * (to - from) * (leader?.file.clip.fps ?? 0);
    return Math.min(max, Math.max(min, shift + Math.round(frames)));
  }
}
