import { el, setAttribute, setHidden, setVariable } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { clockTime } from '../store/format';
import { beatBeside, countedBeats, snapped } from '../store/counting';
import { danceDuration, danceFps } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { apply, type Store, watchAll } from '../store/store';
import { MIN_LOOP, regionSet } from '../store/actions/timeline';
import type { Span, TimeScale } from '../store/time-scale';
import { timelineClicked } from './timeline-click';

/** The elements that the region lies on. */
interface LoopPlaces {
  /** A drag here draws a region from beat to beat, with Alt from any time to any other; a click jumps, a double click removes the region. */
  readonly ruler: HTMLElement;
  /** Gets the focus of a handle that goes. */
  readonly playhead: HTMLElement;
  /** Lies over all lanes and holds the band; not the playhead, since nothing inside a slider is told to screen readers. */
  readonly overlay: HTMLElement;
  readonly scale: () => TimeScale;
}

type End = 'from' | 'to';
const ENDS: readonly End[] = ['from', 'to'];

/** Direction of a step, by key. */
const ARROWS: Readonly<Record<string, 1 | -1>> = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };

/** How far outside the picture, as a share of its width, an end still counts as inside. */
const TOLERANCE = 1e-6;

/** The looped region: a tinted band over the lanes with a handle at each end. */
export class LoopRegion {
  readonly #store: Store;
  readonly #places: LoopPlaces;
  readonly #band = el('div', { class: 'loop' });
  readonly #handles: Readonly<Record<End, HTMLElement>> = {
    from: createHandle('Loop start'),
    to: createHandle('Loop end'),
  };
  /** The region while it is being dragged; it is set when the pointer is up. */
  #dragged: Span | null = null;

  constructor(store: Store, services: Services, places: LoopPlaces) {
    this.#store = store;
    this.#places = places;
    const { ruler, overlay, playhead } = places;
    overlay.append(this.#band, this.#handles.from, this.#handles.to);
    const clear = (): void => {
      if (store.getState().playback.region) apply(store, regionSet(null));
    };
    // The first click on the ruler may move the playhead's handle under the pointer.
    for (const place of [ruler, overlay, playhead]) place.addEventListener('dblclick', clear);
    watchAll(
      store,
      ({ playback, zoom }) => [playback.region, playback.loop, zoom],
      () => {
        this.draw();
      },
    );
    this.#dragOnRuler(services);
    for (const end of ENDS) {
      this.#dragHandle(end);
      this.#handles[end].addEventListener('keydown', (event) => {
        this.#moveByKey(end, event);
      });
    }
  }

  /** Places band and handles. */
  draw(): void {
    const state = this.#store.getState();
    const region = this.#dragged ?? state.playback.region;
    const scale = this.#places.scale();
    const place = (time: number): number => (scale.width > 0 ? scale.x(time) / scale.width : 0);
    for (const end of ENDS) {
      const at = region ? place(region[end]) : 0;
      const isOutside = at < -TOLERANCE || at > 1 + TOLERANCE;
      setHidden(this.#handles[end], !region || isOutside, this.#places.playhead);
      if (region) showHandle(this.#handles[end], at, region[end], state);
    }
    this.#band.hidden = !region || region.to <= scale.from || region.from >= scale.to;
    if (!region) return;
    const [left, right] = [Math.max(0, place(region.from)), Math.min(1, place(region.to))];
    setVariable(this.#band, '--from', left);
    setVariable(this.#band, '--span', Math.max(0, right - left));
    this.#band.classList.toggle('off', !state.playback.loop && !this.#dragged);
    setAttribute(this.#band, 'data-cut', cutEnds(region, scale));
  }

  #timeAt(event: PointerEvent): number {
    const { scale, overlay } = this.#places;
    const time = scale().time(event.clientX - overlay.getBoundingClientRect().left);
    return Math.min(danceDuration(this.#store.getState()), Math.max(0, time));
  }

  /** The beat nearest to the pointer; with Alt, or where there is none, the time under it. */
  #beatAt(event: PointerEvent): number {
    const time = this.#timeAt(event);
    return event.altKey ? time : snappedInside(this.#store.getState(), time);
  }

  #drag(region: Span | null): void {
    this.#dragged = region;
    this.draw();
  }

  #dragOnRuler(services: Services): void {
    let start = 0;
    draggable(this.#places.ruler, {
      begin: (event) => {
        start = this.#beatAt(event);
        return danceDuration(this.#store.getState()) > 0;
      },
      move: (_, event) => {
        this.#drag(this.#drawn(start, event));
      },
      drop: (_, event) => {
        this.#dragged = null;
        apply(this.#store, regionSet(this.#drawn(start, event)));
      },
      click: (event) => {
        timelineClicked(this.#store, services, this.#timeAt(event), event);
      },
      cancel: () => {
        this.#drag(null);
      },
    });
  }

  /** The region from where a drag began to the pointer: at least one beat. */
  #drawn(start: number, event: PointerEvent): Span {
    const end = this.#beatAt(event);
    if (end !== start) return ordered({ from: start, to: end });
    return { from: start, to: beatBeside(countedBeats(this.#store.getState()), start, 1) ?? end };
  }

  #dragHandle(end: End): void {
    draggable(this.#handles[end], {
      move: (_, event) => {
        const { region } = this.#store.getState().playback;
        if (region) this.#drag(ordered({ ...region, [end]: this.#beatAt(event) }));
      },
      drop: () => {
        const region = this.#dragged;
        this.#dragged = null;
        if (region) apply(this.#store, regionSet(region));
      },
      cancel: () => {
        this.#drag(null);
      },
    });
  }

  /** An arrow key moves an end by a frame, with Shift to the next beat, or by a second where there is none; not past the other end. */
  #moveByKey(end: End, event: KeyboardEvent): void {
    const by = ARROWS[event.key];
    const { region } = this.#store.getState().playback;
    if (!region || by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const state = this.#store.getState();
    const beat = event.shiftKey ? beatBeside(countedBeats(state), region[end], by) : null;
    const step = event.shiftKey ? 1 : 1 / danceFps(state);
    const time = beat ?? region[end] + by * step;
    const next =
      end === 'from'
        ? { ...region, from: Math.min(time, region.to - MIN_LOOP) }
        : { ...region, to: Math.max(time, region.from + MIN_LOOP) };
    apply(this.#store, regionSet(next));
  }
}

function createHandle(label: string): HTMLElement {
  return el('div', {
    class: 'loop-handle',
    attributes: {
      'data-own-pointer': true,
      role: 'slider',
      tabindex: 0,
      'aria-label': label,
      'aria-valuemin': 0,
      title: `${label}: drag it from beat to beat, with Alt to any time, double click to remove the loop`,
    },
  });
}

/** @param at its place in the picture, 0 to 1 */
function showHandle(handle: HTMLElement, at: number, time: number, state: AppState): void {
  setVariable(handle, '--at', at);
  handle.setAttribute('aria-valuemax', danceDuration(state).toFixed(2));
  handle.setAttribute('aria-valuenow', time.toFixed(2));
  handle.setAttribute('aria-valuetext', clockTime(time));
}

/** The nearest beat that the dance has; the time itself where there is none. */
function snappedInside(state: AppState, time: number): number {
  const beat = snapped(countedBeats(state), time);
  return beat >= 0 && beat <= danceDuration(state) ? beat : time;
}

function ordered({ from, to }: Span): Span {
  return { from: Math.min(from, to), to: Math.max(from, to) };
}

/** Which ends of a region lie outside the picture: the band has no edge there. */
function cutEnds(region: Span, { from, to }: Span): string | undefined {
  const ends = [region.from < from ? 'from' : '', region.to > to ? 'to' : ''].filter(Boolean);
  return ends.length > 0 ? ends.join(' ') : undefined;
}
