/** Callbacks of a drag. Distances are CSS pixels from where it began. */
interface Drag {
  /** The pointer is down; false declines. */
  readonly begin?: (event: PointerEvent) => boolean;
  /** The pointer has moved by more than the threshold. */
  readonly move: (distance: number, event: PointerEvent) => void;
  /** The pointer is up again: after a drag, or without one. */
  readonly drop?: (distance: number, event: PointerEvent) => void;
  readonly click?: (event: PointerEvent) => void;
  /** Escape was pressed, or the system cancelled the pointer. */
  readonly cancel: () => void;
}

/** Distance from which a press is a drag. */
export const DRAG_THRESHOLD_PX = 4;

/** Makes an element draggable to the left and right. */
export function draggable(element: HTMLElement, drag: Drag): void {
  let from: { readonly pointer: number; readonly x: number } | null = null;
  let moving = false;

  const end = (): void => {
    if (from && element.hasPointerCapture(from.pointer)) element.releasePointerCapture(from.pointer);
    from = null;
    moving = false;
  };
  const cancel = (): void => {
    if (!from) return;
    const wasMoving = moving;
    end();
    if (wasMoving) drag.cancel();
  };
  const down = (event: PointerEvent): void => {
    if (event.button !== 0 || from || drag.begin?.(event) === false) return;
    from = { pointer: event.pointerId, x: event.clientX };
    element.setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent): void => {
    if (event.pointerId !== from?.pointer) return;
    const distance = event.clientX - from.x;
    if (!moving && Math.abs(distance) < DRAG_THRESHOLD_PX) return;
    moving = true;
    drag.move(distance, event);
  };
  const up = (event: PointerEvent): void => {
    if (event.pointerId !== from?.pointer) return;
    const [wasMoving, distance] = [moving, event.clientX - from.x];
    end();
    if (wasMoving) drag.drop?.(distance, event);
    else drag.click?.(event);
  };
  element.addEventListener('pointerdown', down);
  element.addEventListener('pointermove', move);
  element.addEventListener('pointerup', up);
  element.addEventListener('pointercancel', cancel);
  window.addEventListener(
    'keydown',
    (event) => {
      if (event.key !== 'Escape' || !moving) return;
      event.stopPropagation();
      event.preventDefault();
      cancel();
    },
    { capture: true },
  );
}
