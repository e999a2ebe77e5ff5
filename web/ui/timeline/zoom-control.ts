import { iconButton, setDisabled } from '../widgets/button';
import { el } from '../widgets/dom';
import { danceDuration } from '../store/selectors';
import { apply, type Store, watchAll } from '../store/store';
import { magnificationSet, visibleSpan, zoomedBy, zoomSet } from '../store/actions/timeline';
import { largestMagnification, magnification } from '../store/time-scale';

/** Factor of one press of a button or key. */
export const ZOOM_STEP = 1.5;
/** Steps of the slider from the whole dance to the largest zoom; the zoom grows exponentially along it. */
const SLIDER_STEPS = 100;

/** Buttons and a slider for the zoom of the lanes, and one that shows the whole dance. */
export function createZoomControl(store: Store): HTMLElement {
  const out = iconButton('icon', 'minus', { label: 'Zoom out', title: 'Zoom out (−)' }, () => {
    apply(store, zoomedBy(1 / ZOOM_STEP));
  });
  const into = iconButton('icon', 'plus', { label: 'Zoom in', title: 'Zoom in (+)' }, () => {
    apply(store, zoomedBy(ZOOM_STEP));
  });
  const fit = iconButton(
    'icon',
    'fit',
    { label: 'Show the whole dance', title: 'Show the whole dance (0)' },
    () => {
      apply(store, zoomSet(null));
    },
  );
  const slider = el('input', {
    class: 'zoom',
    attributes: {
      type: 'range',
      min: 0,
      max: SLIDER_STEPS,
      step: 1,
      value: 0,
      'aria-label': 'Timeline zoom',
    },
    on: {
      input: () => {
        const max = largestMagnification(danceDuration(store.getState()));
        apply(store, magnificationSet(max ** (Number(slider.value) / SLIDER_STEPS)));
      },
    },
  });
  watchAll(
    store,
    (state) => [state.zoom, state.leader, state.song],
    (state) => {
      const whole = danceDuration(state);
      const max = largestMagnification(whole);
      const times = magnification(visibleSpan(state), whole);
      const part = max > 1 ? Math.log(times) / Math.log(max) : 0;
      slider.value = String(Math.round(part * SLIDER_STEPS));
      slider.setAttribute('aria-valuetext', `${times.toFixed(1)} times`);
      slider.disabled = max <= 1 || whole === 0;
      setDisabled(into, slider.disabled || part > 1 - 1e-6);
      for (const each of [out, fit]) setDisabled(each, state.zoom === null);
    },
  );
  return el('div', { class: 'zoom-control desk' }, out, slider, into, fit);
}
