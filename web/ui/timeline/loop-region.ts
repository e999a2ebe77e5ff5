import { el, setAttribute, setVariable, together } from '../widgets/dom';
import { draggable } from '../widgets/drag';
import { clockTime } from '../store/format';
import { danceDuration, danceFps } from '../store/selectors';
import type { Services } from '../store/services';
import { apply, type Store, watchAll } from '../store/store';
import { regionEndSet, regionSet } from '../store/actions/timeline';
import type { Span, TimeScale } from '../store/time-scale';

/** Where the region is drawn and drawn on. */
export interface LoopPlaces {
  /** A drag here draws a region, a click jumps, a double click takes the region away. */
  readonly ruler: HTMLElement;
  /** Lies over all lanes and holds the band. */
  readonly overlay: HTMLElement;
  readonly scale: () => TimeScale;
}

type End = 'from' | 'to';

/** The loop: a tinted band over the lanes with a grip at each end. */
export function mountLoopRegion(
  store: Store,
  services: Services,
  { ruler, overlay, scale }: LoopPlaces,
): { readonly draw: () => void; readonly dispose: () => void } {
  const band = el('div', { class: 'loop' });
  const grips: Record<End, HTMLElement> = { from: grip('Loop start'), to: grip('Loop end') };
  overlay.append(band, grips.from, grips.to);
  /** The region while it is being drawn; it holds when the pointer is up. */
  let drawn: Span | null = null;

  const draw = (): void => {
    const state = store.getState();
    const { playback } = state;
    const region = drawn ?? playback.region;
    const now = scale();
    const place = (time: number): number => (now.width > 0 ? now.x(time) / now.width : 0);
    band.hidden = !region || region.to <= now.from || region.from >= now.to;
    for (const end of ['from', 'to'] as const) {
      const each = grips[end];
      each.hidden = !region || place(region[end]) < -1e-6 || place(region[end]) > 1 + 1e-6;
      if (!region) continue;
      setVariable(each, '--at', place(region[end]));
      each.setAttribute('aria-valuemax', danceDuration(state).toFixed(2));
      each.setAttribute('aria-valuenow', region[end].toFixed(2));
      each.setAttribute('aria-valuetext', clockTime(region[end]));
    }
    if (!region) return;
    const [left, right] = [Math.max(0, place(region.from)), Math.min(1, place(region.to))];
    setVariable(band, '--from', left);
    setVariable(band, '--span', Math.max(0, right - left));
    band.classList.toggle('off', !playback.loop && !drawn);
    setAttribute(band, 'data-cut', cutEnds(region, now));
  };
  const timeAt = (event: PointerEvent): number => {
    const time = scale().time(event.clientX - overlay.getBoundingClientRect().left);
    return Math.min(danceDuration(store.getState()), Math.max(0, time));
  };
  const settle = (): void => {
    drawn = null;
    draw();
  };

  let anchor = 0;
  const undoRuler = draggable(ruler, {
    begin: (event) => {
      anchor = timeAt(event);
      return danceDuration(store.getState()) > 0;
    },
    move: (_, event) => {
      const time = timeAt(event);
      drawn = { from: Math.min(anchor, time), to: Math.max(anchor, time) };
      draw();
    },
    drop: (event) => {
      const time = timeAt(event);
      drawn = null;
      apply(store, regionSet({ from: anchor, to: time }));
    },
    click: (event) => {
      services.seek(timeAt(event));
    },
    cancel: settle,
  });
  const clear = (): void => {
    if (store.getState().playback.region) apply(store, regionSet(null));
  };
  ruler.addEventListener('dblclick', clear);
  // Its first click may bring the playhead's grip under the pointer.
  overlay.addEventListener('dblclick', clear);

  const undoGrips = (['from', 'to'] as const).map((end) => {
    const each = grips[end];
    each.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const { region } = store.getState().playback;
      if (!region || by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      const hop = event.shiftKey ? 1 : 1 / danceFps(store.getState());
      apply(store, regionEndSet(end, region[end] + by * hop));
    });
    return draggable(each, {
      move: (_, event) => {
        const { region } = store.getState().playback;
        if (region) drawn = { ...region, [end]: timeAt(event) };
        if (drawn) drawn = { from: Math.min(drawn.from, drawn.to), to: Math.max(drawn.from, drawn.to) };
        draw();
      },
      drop: () => {
        const region = drawn;
        drawn = null;
        if (region) apply(store, regionSet(region));
      },
      click: () => undefined,
      cancel: settle,
    });
  });

  return {
    draw,
    dispose: together(
      watchAll(store, ({ playback, zoom }) => [playback.region, playback.loop, zoom], draw),
      undoRuler,
      ...undoGrips,
    ),
  };
}

function grip(label: string): HTMLElement {
  return el('div', {
    class: 'loop-grip',
    attributes: {
      'data-own-pointer': true,
      role: 'slider',
      tabindex: 0,
      'aria-label': label,
      'aria-valuemin': 0,
      title: `${label}: drag to change it, double click to take the loop away`,
    },
  });
}

/** Which ends of a region lie outside the picture: they get no edge. */
function cutEnds(region: Span, { from, to }: Span): string | undefined {
  const ends = [region.from < from ? 'from' : '', region.to > to ? 'to' : ''].filter(Boolean);
  return ends.length > 0 ? ends.join(' ') : undefined;
}
