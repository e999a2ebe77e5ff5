/**
 * Lets the page do what else it has to (drawing, clicks) and comes back. Unlike a timer it is not slowed down to a turn
 * a second while the tab is in the background.
 */
export function breath(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}
