import { el, setVariable, together } from './dom';
import { barAt, danceDuration } from './selectors';
import type { Mount } from './services';
import { watchAll } from './store';

/** The playhead: one slider over all lanes. Pointer and keys move it, playing or not. */
export const mountPlayhead: Mount = (root, store, services) => {
  const line = el('div', { class: 'head-line' });
  const slider = el(
    'div',
    {
      class: 'playhead',
      attributes: { role: 'slider', tabindex: 0, 'aria-label': 'Playhead', 'aria-valuemin': 0 },
    },
    line,
  );
  root.append(slider);

  const toPointer = (event: PointerEvent): void => {
    const box = slider.getBoundingClientRect();
    services.seek(((event.clientX - box.left) / box.width) * danceDuration(store.getState()));
  };
  slider.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || danceDuration(store.getState()) === 0) return;
    slider.setPointerCapture(event.pointerId);
    toPointer(event);
  });
  slider.addEventListener('pointermove', (event) => {
    if (slider.hasPointerCapture(event.pointerId)) toPointer(event);
  });

  return together(
    watchAll(
      store,
      (state) => [state.playback.time, state.leader, state.song],
      (state) => {
        const whole = danceDuration(state);
        const { time } = state.playback;
        setVariable(line, '--at', whole > 0 ? time / whole : 0);
        slider.setAttribute('aria-valuemax', whole.toFixed(1));
        slider.setAttribute('aria-valuenow', time.toFixed(1));
        slider.setAttribute('aria-disabled', String(whole === 0));
        const place = barAt(state.song?.data.beats ?? [], time);
        const counted = place ? `, bar ${place.bar}, count ${place.count}` : '';
        slider.setAttribute('aria-valuetext', `${time.toFixed(1)} seconds${counted}`);
      },
    ),
    () => {
      slider.remove();
    },
  );
};
