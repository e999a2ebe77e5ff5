/**
 * Calls `listener` when an element is shown and whenever it is drawn with another number of device pixels: it has
 * another size, or the window has gone to a screen with another density, which resizes no element. Returns how to stop
 * that.
 */
export function onPixelSize(element: Element, listener: () => void): () => void {
  const sizes = new ResizeObserver(listener);
  sizes.observe(element);
  let density: MediaQueryList;
  const watchDensity = (): void => {
    density = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    density.addEventListener('change', densityChanged, { once: true });
  };
  const densityChanged = (): void => {
    watchDensity();
    listener();
  };
  watchDensity();
  return () => {
    sizes.disconnect();
    density.removeEventListener('change', densityChanged);
  };
}
