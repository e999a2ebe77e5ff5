import { el, setVariable } from '../widgets/dom';
import { DRAG_THRESHOLD_PX } from '../widgets/drag';
import { barAt, countedBeats } from '../store/counting';
import { danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { type Store, watchAll } from '../store/store';
import type { TimeScale } from '../store/time-scale';
import { timelineClicked } from './timeline-click';

/** How far outside the picture, as a share of its width, the playhead still counts as inside. */
const TOLERANCE = 1e-6;

/**
 * The playhead: one slider over all lanes, moved by keys, by its handle and by a press on any lane, playing or not.
 * Lanes that use the pointer otherwise, and buttons in lanes, are left alone: `data-own-pointer` marks them.
 */
export class Playhead {
  readonly root: HTMLElement;
  readonly #line = el('div', { class: 'head-line' }, el('div', { class: 'head-handle' }));
  readonly #store: Store;
  readonly #services: Services;
  readonly #scale: () => TimeScale;
  /** The pointer that moves it. */
  #pointer: number | null = null;
  /** Where a finger came down, until it is clear whether it scrolls the page or moves the playhead; CSS pixels. */
  #undecided: { readonly x: number; readonly y: number } | null = null;

  constructor(lanes: HTMLElement, store: Store, services: Services, scale: () => TimeScale) {
    this.#store = store;
    this.#services = services;
    this.#scale = scale;
    this.root = el(
      'div',
      {
        class: 'playhead',
        attributes: { role: 'slider', tabindex: 0, 'aria-label': 'Playhead', 'aria-valuemin': 0 },
      },
      this.#line,
    );
    this.#listen(lanes);
    watchAll(
      store,
      ({ playback, zoom, leader, song, shift, countings }) => [
        playback.time,
        playback.playing,
        zoom,
        leader,
        song,
        shift,
        countings,
      ],
      (state) => {
        this.draw();
        // Screen readers read out each change of the slider that has the focus, over the music.
        if (!state.playback.playing || this.root !== document.activeElement) this.#describe(state);
      },
    );
  }

  /** Places the line. */
  draw(): void {
    const scale = this.#scale();
    const at = scale.width > 0 ? scale.x(this.#store.getState().playback.time) / scale.width : 0;
    this.#line.hidden = at < -TOLERANCE || at > 1 + TOLERANCE;
    setVariable(this.#line, '--at', at);
  }

  /** Tells screen readers where it is. */
  #describe(state: AppState): void {
    const { time } = state.playback;
    const duration = danceDuration(state);
    const place = barAt(countedBeats(state), time);
    const counted = place
      ? `, bar ${place.bar < 1 ? 'before the first' : place.bar}, count ${place.count}`
      : '';
    this.root.setAttribute('aria-valuemax', duration.toFixed(1));
    this.root.setAttribute('aria-valuenow', time.toFixed(1));
    this.root.setAttribute('aria-disabled', String(duration === 0));
    this.root.setAttribute('aria-valuetext', `${time.toFixed(1)} seconds${counted}`);
  }

  #listen(lanes: HTMLElement): void {
    lanes.addEventListener('pointerdown', (event) => {
      this.#down(event);
    });
    lanes.addEventListener('pointermove', (event) => {
      this.#move(event);
    });
    lanes.addEventListener('pointerup', (event) => {
      this.#up(event);
    });
    lanes.addEventListener('pointercancel', (event) => {
      if (event.pointerId === this.#pointer) this.#pointer = null;
    });
  }

  #down(event: PointerEvent): void {
    const target = event.target instanceof Element ? event.target : null;
    if (!target || !movesPlayhead(target) || event.button !== 0) return;
    if (danceDuration(this.#store.getState()) === 0) return;
    this.#pointer = event.pointerId;
    // A captured pointer's clicks go to the element that captured it: the handle passes a double click on.
    target.setPointerCapture(this.#pointer);
    this.#undecided = event.pointerType === 'touch' ? { x: event.clientX, y: event.clientY } : null;
    if (!this.#undecided) this.#seekTo(event);
  }

  #move(event: PointerEvent): void {
    if (event.pointerId !== this.#pointer) return;
    if (this.#undecided) {
      const across = Math.abs(event.clientX - this.#undecided.x);
      if (across < DRAG_THRESHOLD_PX || across < Math.abs(event.clientY - this.#undecided.y)) return;
    }
    this.#undecided = null;
    this.#seekTo(event);
  }

  #up(event: PointerEvent): void {
    if (event.pointerId !== this.#pointer) return;
    if (this.#undecided) timelineClicked(this.#store, this.#services, this.#timeAt(event), event);
    this.#pointer = null;
  }

  #seekTo(event: PointerEvent): void {
    this.#services.seek(this.#timeAt(event));
  }

  #timeAt(event: PointerEvent): number {
    const time = this.#scale().time(event.clientX - this.root.getBoundingClientRect().left);
    return Math.min(danceDuration(this.#store.getState()), Math.max(0, time));
  }
}

/** Whether a press on this element moves the playhead: on its handle, and on lanes that do nothing else with it. */
function movesPlayhead(target: Element): boolean {
  if (target.matches('.head-handle')) return true;
  return target.closest('.lane') !== null && target.closest('[data-own-pointer], button') === null;
}
