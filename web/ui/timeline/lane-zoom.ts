import { el, setVariable, together } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { danceDuration } from '../store/selectors';
import { apply, type Store, watch, watchAll } from '../store/store';
import { scrolledTo, visibleSpan, zoomedBy, zoomSet } from '../store/actions/timeline';
import { scrolled, type TimeScale, zoomed } from '../store/time-scale';

/** Zoom of one wheel pixel; a wheel's notch is about 100 of them, a pinch on a pad a few. */
const PER_PIXEL = 0.01;
const MOST_PIXELS = 40;
/** Pixels of a line of a wheel that counts in lines. */
const LINE = 16;

/** The hands on the lanes: wheel and pinch zoom around the pointer, wheel and bar scroll, the playhead is followed. */
export function mountLaneZoom(
  store: Store,
  lanes: HTMLElement,
  tracks: HTMLElement,
  scale: () => TimeScale,
): () => void {
  const timeAt = (x: number): number => scale().time(x - tracks.getBoundingClientRect().left);
  const whole = (): number => danceDuration(store.getState());
  const scroll = (pixels: number): void => {
    const { from, to, width } = scale();
    apply(store, zoomSet(scrolled({ from, to }, whole(), (pixels / width) * (to - from))));
  };

  const onWheel = (event: WheelEvent): void => {
    if (whole() === 0) return;
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1;
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      const pixels = Math.max(-MOST_PIXELS, Math.min(MOST_PIXELS, event.deltaY * unit));
      apply(store, zoomedBy(Math.exp(-pixels * PER_PIXEL), timeAt(event.clientX)));
      return;
    }
    if (!store.getState().zoom) return;
    event.preventDefault();
    scroll((Math.abs(event.deltaX) > Math.abs(event.deltaY) ? event.deltaX : event.deltaY) * unit);
  };
  lanes.addEventListener('wheel', onWheel, { passive: false });

  const undoPinch = onPinch(lanes, (middle, factor, by) => {
    if (whole() === 0) return;
    const larger = zoomed(visibleSpan(store.getState()), whole(), factor, timeAt(middle));
    const { width } = scale();
    apply(store, zoomSet(scrolled(larger, whole(), (-by / width) * (larger.to - larger.from))));
  });

  const thumb = el('div', { class: 'thumb' });
  const bar = el('div', { class: 'scroll', attributes: { 'aria-hidden': 'true' } }, thumb);
  lanes.append(bar);
  let before = { from: 0, to: 0 };
  const undoThumb = draggable(thumb, {
    begin: () => {
      before = visibleSpan(store.getState());
      return true;
    },
    move: (distance) => {
      apply(store, zoomSet(scrolled(before, whole(), (distance / bar.clientWidth) * whole())));
    },
    drop: () => undefined,
    click: () => undefined,
    cancel: () => {
      apply(store, zoomSet(before));
    },
  });

  let last = store.getState().playback.time;
  return together(
    watch(
      store,
      (state) => state.playback.time,
      (time, { zoom, playback }) => {
        // Who looked elsewhere while it plays goes on looking there.
        const wasSeen = zoom && last >= zoom.from && last <= zoom.to;
        last = time;
        if (wasSeen || !playback.playing) apply(store, scrolledTo(time));
      },
    ),
    watchAll(
      store,
      (state) => [state.zoom, state.leader, state.song],
      (state) => {
        const { from, to } = visibleSpan(state);
        bar.hidden = state.zoom === null;
        setVariable(thumb, '--from', whole() > 0 ? from / whole() : 0);
        setVariable(thumb, '--span', whole() > 0 ? (to - from) / whole() : 1);
      },
    ),
    undoPinch,
    undoThumb,
    () => {
      lanes.removeEventListener('wheel', onWheel);
    },
  );
}

/**
 * Two fingers: the place between them, by how much they spread and how far they moved since the last time. Whatever
 * the first finger had begun is taken back when the second one comes.
 */
function onPinch(
  element: HTMLElement,
  change: (middle: number, factor: number, by: number) => void,
): () => void {
  const fingers = new Map<number, number>();
  const look = (): { middle: number; apart: number } | null => {
    const [a, b] = [...fingers.values()];
    return a === undefined || b === undefined
      ? null
      : { middle: (a + b) / 2, apart: Math.max(20, Math.abs(a - b)) };
  };
  /** Where the first finger came down. */
  let begun: EventTarget | null = null;
  const down = (event: PointerEvent): void => {
    if (event.pointerType !== 'touch' || fingers.size === 2) return;
    const [first] = fingers.keys();
    fingers.set(event.pointerId, event.clientX);
    if (first === undefined) {
      begun = event.target;
      return;
    }
    event.stopPropagation();
    begun?.dispatchEvent(new PointerEvent('pointercancel', { pointerId: first, bubbles: true }));
    // Fingers that slide off the lanes go on zooming, and are missed nowhere when they are lifted.
    for (const finger of fingers.keys()) element.setPointerCapture(finger);
  };
  const move = (event: PointerEvent): void => {
    if (!fingers.has(event.pointerId)) return;
    const before = look();
    fingers.set(event.pointerId, event.clientX);
    const after = look();
    if (!before || !after) return;
    change(before.middle, after.apart / before.apart, after.middle - before.middle);
  };
  const up = (event: PointerEvent): void => {
    if (event.isTrusted) fingers.delete(event.pointerId);
  };
  const heard = { pointerdown: down, pointermove: move, pointerup: up, pointercancel: up } as const;
  const types = Object.keys(heard) as (keyof typeof heard)[];
  for (const type of types) element.addEventListener(type, heard[type], { capture: true });
  return () => {
    for (const type of types) element.removeEventListener(type, heard[type], { capture: true });
  };
}
