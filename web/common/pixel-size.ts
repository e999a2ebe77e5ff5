/**
 * Calls `listener` when an element is shown and whenever it is drawn with another number of device pixels: it has
 * another size, or the window has gone to a screen with another density, which resizes no element.
 */
export function onPixelSize(element: Element, listener: () => void): void {
  new ResizeObserver(listener).observe(element);
  const watchDensity = (): void => {
    const density = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    density.addEventListener('change', densityChanged, { once: true });
  };
  const densityChanged = (): void => {
    watchDensity();
    listener();
  };
  watchDensity();
}
