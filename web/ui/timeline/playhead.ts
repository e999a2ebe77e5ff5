import { el, setVariable, together } from '../widgets/dom';
import { DRAG_THRESHOLD_PX } from '../widgets/drag';
import { barAt, danceDuration } from '../store/selectors';
import type { Services } from '../store/services';
import { musicBeats } from '../store/song-shift';
import { type Store, watchAll } from '../store/store';
import type { TimeScale } from '../store/time-scale';

/**
 * The playhead: one slider over all lanes. Keys, its own grip and a press on any lane move it, playing or not. Lanes
 * that do something else with the pointer, and buttons in lanes, keep it to themselves with `data-own-pointer`.
 */
export function createPlayhead(
  lanes: HTMLElement,
  store: Store,
  services: Services,
  scale: () => TimeScale,
): { readonly root: HTMLElement; readonly draw: () => void; readonly dispose: () => void } {
  const line = el('div', { class: 'head-line' }, el('div', { class: 'head-grip' }));
  const slider = el(
    'div',
    {
      class: 'playhead',
      attributes: { role: 'slider', tabindex: 0, 'aria-label': 'Playhead', 'aria-valuemin': 0 },
    },
    line,
  );

  let pointer: number | null = null;
  /** Where a finger came down that may yet turn out to scroll the page or to zoom. */
  let waiting: { readonly x: number; readonly y: number } | null = null;
  const toPointer = (event: PointerEvent): void => {
    const time = scale().time(event.clientX - slider.getBoundingClientRect().left);
    services.seek(Math.min(danceDuration(store.getState()), Math.max(0, time)));
  };
  const down = (event: PointerEvent): void => {
    const target = event.target instanceof Element ? event.target : null;
    const isGrip = target?.matches('.head-grip') ?? false;
    const isLane = target?.closest('.lane') && !target.closest('[data-own-pointer], button');
    if (!target || !(isGrip || isLane) || event.button !== 0 || danceDuration(store.getState()) === 0) return;
    pointer = event.pointerId;
    // Clicks go to whoever holds the pointer: the grip passes a double click on.
    target.setPointerCapture(pointer);
    waiting = event.pointerType === 'touch' ? { x: event.clientX, y: event.clientY } : null;
    if (!waiting) toPointer(event);
  };
  const move = (event: PointerEvent): void => {
    if (event.pointerId !== pointer) return;
    const along = waiting ? Math.abs(event.clientX - waiting.x) : Infinity;
    if (along < DRAG_THRESHOLD_PX || (waiting && along < Math.abs(event.clientY - waiting.y))) return;
    waiting = null;
    toPointer(event);
  };
  const up = (event: PointerEvent): void => {
    if (event.pointerId !== pointer) return;
    if (waiting) toPointer(event);
    pointer = null;
  };
  const cancel = (event: PointerEvent): void => {
    if (event.pointerId === pointer) pointer = null;
  };
  lanes.addEventListener('pointerdown', down);
  lanes.addEventListener('pointermove', move);
  lanes.addEventListener('pointerup', up);
  lanes.addEventListener('pointercancel', cancel);

  const draw = (): void => {
    const now = scale();
    const place = now.width > 0 ? now.x(store.getState().playback.time) / now.width : 0;
    line.hidden = place < -1e-6 || place > 1 + 1e-6;
    setVariable(line, '--at', place);
  };
  return {
    root: slider,
    draw,
    dispose: together(
      watchAll(
        store,
        (state) => [state.playback.time, state.zoom, state.leader, state.song, state.shift],
        (state) => {
          draw();
          const { time } = state.playback;
          const whole = danceDuration(state);
          slider.setAttribute('aria-valuemax', whole.toFixed(1));
          slider.setAttribute('aria-valuenow', time.toFixed(1));
          slider.setAttribute('aria-disabled', String(whole === 0));
          const place = barAt(musicBeats(state), time);
          const counted = place ? `, bar ${place.bar}, count ${place.count}` : '';
          slider.setAttribute('aria-valuetext', `${time.toFixed(1)} seconds${counted}`);
        },
      ),
      () => {
        lanes.removeEventListener('pointerdown', down);
        lanes.removeEventListener('pointermove', move);
        lanes.removeEventListener('pointerup', up);
        lanes.removeEventListener('pointercancel', cancel);
      },
    ),
  };
}
