import { el, setVariable } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { onPinch } from '../widgets/pinch';
import { danceDuration } from '../store/selectors';
import { apply, type Store, watch, watchAll } from '../store/store';
import { scrolledTo, visibleSpan, zoomedBy, zoomSet } from '../store/actions/timeline';
import { scrolled, type TimeScale, zoomed } from '../store/time-scale';

/** Logarithm of the zoom of one wheel pixel; a wheel's notch is about 100 pixels, a pinch on a touchpad a few. */
const ZOOM_PER_PIXEL = 0.01;
/** Pixels of one wheel event that count at most. */
const MAX_PIXELS = 40;
/** Pixels of a line, for wheels that count in lines. */
const LINE_PIXELS = 16;

/**
 * Zoom and scroll of the lanes: wheel and pinch zoom around the pointer, wheel and scroll bar scroll, and the lanes
 * follow the playhead.
 */
export function mountLaneZoom(
  store: Store,
  lanes: HTMLElement,
  tracks: HTMLElement,
  scale: () => TimeScale,
): void {
  const timeAt = (x: number): number => scale().time(x - tracks.getBoundingClientRect().left);
  followPlayhead(store);
  onWheel(store, lanes, timeAt, (pixels) => {
    const { from, to, width } = scale();
    apply(store, zoomSet(scrolled({ from, to }, duration(store), (pixels / width) * (to - from))));
  });
  onPinch(lanes, (middle, factor, by) => {
    if (duration(store) === 0) return;
    const larger = zoomed(visibleSpan(store.getState()), duration(store), factor, timeAt(middle));
    const { width } = scale();
    apply(store, zoomSet(scrolled(larger, duration(store), (-by / width) * (larger.to - larger.from))));
  });
  mountScrollBar(store, lanes);
}

function duration(store: Store): number {
  return danceDuration(store.getState());
}

/** With Ctrl or Command a wheel zooms (browsers report a touchpad's pinch so), else it scrolls while zoomed in. */
function onWheel(
  store: Store,
  lanes: HTMLElement,
  timeAt: (x: number) => number,
  scroll: (pixels: number) => void,
): void {
  const listener = (event: WheelEvent): void => {
    if (duration(store) === 0) return;
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PIXELS : 1;
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      const pixels = Math.max(-MAX_PIXELS, Math.min(MAX_PIXELS, event.deltaY * unit));
      apply(store, zoomedBy(Math.exp(-pixels * ZOOM_PER_PIXEL), timeAt(event.clientX)));
      return;
    }
    if (!store.getState().zoom) return;
    event.preventDefault();
    scroll((Math.abs(event.deltaX) > Math.abs(event.deltaY) ? event.deltaX : event.deltaY) * unit);
  };
  lanes.addEventListener('wheel', listener, { passive: false });
}

/** The bar under the lanes while they show a part of the dance. */
function mountScrollBar(store: Store, lanes: HTMLElement): void {
  const thumb = el('div', { class: 'thumb' });
  const bar = el('div', { class: 'scroll', attributes: { 'aria-hidden': 'true' } }, thumb);
  lanes.append(bar);
  let before = { from: 0, to: 0 };
  draggable(thumb, {
    begin: () => {
      before = visibleSpan(store.getState());
      return true;
    },
    move: (distance) => {
      const whole = duration(store);
      apply(store, zoomSet(scrolled(before, whole, (distance / bar.clientWidth) * whole)));
    },
    cancel: () => {
      apply(store, zoomSet(before));
    },
  });
  watchAll(
    store,
    (state) => [state.zoom, state.leader, state.song],
    (state) => {
      const { from, to } = visibleSpan(state);
      const whole = danceDuration(state);
      bar.hidden = state.zoom === null;
      setVariable(thumb, '--from', whole > 0 ? from / whole : 0);
      setVariable(thumb, '--span', whole > 0 ? (to - from) / whole : 1);
    },
  );
}

/** Scrolls to the playhead when it leaves the shown part; while it plays outside of it, the lanes stay. */
function followPlayhead(store: Store): void {
  let last = store.getState().playback.time;
  watch(
    store,
    (state) => state.playback.time,
    (time, { zoom, playback }) => {
      const wasShown = zoom && last >= zoom.from && last <= zoom.to;
      last = time;
      if (wasShown || !playback.playing) apply(store, scrolledTo(time));
    },
  );
}
