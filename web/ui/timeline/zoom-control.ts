import { el, together } from '../widgets/dom';
import { icon, type IconName } from '../widgets/icons';
import { danceDuration } from '../store/selectors';
import { apply, type Store, watchAll } from '../store/store';
import { magnificationSet, visibleSpan, zoomedBy, zoomSet } from '../store/actions/timeline';
import { largestMagnification, magnification } from '../store/time-scale';

/** Zoom of one press of a button or key. */
export const ZOOM_STEP = 1.5;
/** Steps of the slider from all of the dance to its largest. */
const STEPS = 100;

/** Zoom out, slider, zoom in, and all of the dance. */
export function createZoomControl(store: Store): {
  readonly root: HTMLElement;
  readonly dispose: () => void;
} {
  const out = button('minus', 'Zoom out', 'Zoom out (−)', () => {
    apply(store, zoomedBy(1 / ZOOM_STEP));
  });
  const into = button('plus', 'Zoom in', 'Zoom in (+)', () => {
    apply(store, zoomedBy(ZOOM_STEP));
  });
  const fit = button('fit', 'Show the whole dance', 'Show the whole dance (0)', () => {
    apply(store, zoomSet(null));
  });
  const slider = el('input', {
    class: 'zoom',
    attributes: { type: 'range', min: 0, max: STEPS, step: 1, value: 0, 'aria-label': 'Timeline zoom' },
    on: {
      input: () => {
        const most = largestMagnification(danceDuration(store.getState()));
        apply(store, magnificationSet(most ** (Number(slider.value) / STEPS)));
      },
    },
  });
  const root = el('div', { class: 'zooming desk' }, out, slider, into, fit);
  return {
    root,
    dispose: together(
      watchAll(
        store,
        (state) => [state.zoom, state.leader, state.song],
        (state) => {
          const whole = danceDuration(state);
          const most = largestMagnification(whole);
          const times = magnification(visibleSpan(state), whole);
          const part = most > 1 ? Math.log(times) / Math.log(most) : 0;
          slider.value = String(Math.round(part * STEPS));
          slider.setAttribute('aria-valuetext', `${times.toFixed(1)} times`);
          for (const each of [slider, into]) each.disabled = most <= 1 || whole === 0;
          into.disabled ||= part > 1 - 1e-6;
          out.disabled = fit.disabled = state.zoom === null;
        },
      ),
    ),
  };
}

function button(sign: IconName, label: string, title: string, run: () => void): HTMLButtonElement {
  return el(
    'button',
    { class: 'icon', attributes: { type: 'button', 'aria-label': label, title }, on: { click: run } },
    icon(sign),
  );
}
