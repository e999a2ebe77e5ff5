/** Least distance between two fingers that counts, CSS pixels: closer ones would make the factor jump. */
const MIN_DISTANCE = 20;

/**
 * Listens for pinches with two fingers. What the first finger had begun is cancelled when the second one comes.
 * @param change is called with the x in the middle of the fingers before (client pixels), the factor by which their
 * distance has grown and the pixels by which their middle has moved since the last call
 */
export function onPinch(
  element: HTMLElement,
  change: (middle: number, factor: number, by: number) => void,
): void {
  /** x of each finger, by its pointer. */
  const fingers = new Map<number, number>();
  let firstTarget: EventTarget | null = null;
  const down = (event: PointerEvent): void => {
    if (event.pointerType !== 'touch' || fingers.size === 2) return;
    const [first] = fingers.keys();
    fingers.set(event.pointerId, event.clientX);
    if (first === undefined) {
      firstTarget = event.target;
      return;
    }
    event.stopPropagation();
    firstTarget?.dispatchEvent(new PointerEvent('pointercancel', { pointerId: first, bubbles: true }));
    // Captured, fingers go on zooming when they slide off the element, and their end is noticed there too.
    for (const finger of fingers.keys()) element.setPointerCapture(finger);
  };
  const move = (event: PointerEvent): void => {
    if (!fingers.has(event.pointerId)) return;
    const before = measure(fingers);
    fingers.set(event.pointerId, event.clientX);
    const after = measure(fingers);
    if (!before || !after) return;
    change(before.middle, after.distance / before.distance, after.middle - before.middle);
  };
  const up = (event: PointerEvent): void => {
    if (event.isTrusted) fingers.delete(event.pointerId);
  };
  element.addEventListener('pointerdown', down, { capture: true });
  element.addEventListener('pointermove', move, { capture: true });
  for (const type of ['pointerup', 'pointercancel'] as const)
    element.addEventListener(type, up, { capture: true });
}

/** Middle and distance of two fingers, pixels; null while there are not two. */
function measure(fingers: ReadonlyMap<number, number>): { middle: number; distance: number } | null {
  const [a, b] = [...fingers.values()];
  if (a === undefined || b === undefined) return null;
  return { middle: (a + b) / 2, distance: Math.max(MIN_DISTANCE, Math.abs(a - b)) };
}
